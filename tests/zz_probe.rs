#[path = "common/draw.rs"]
#[allow(dead_code)]
mod draw;
use proptest::prelude::Rng;
use proptest::test_runner::*;
use sawflutter::scene::*;
use sawflutter::plate::*;
use sawflutter::spectrum::*;
use sawflutter::stability::*;
#[test]
fn probe() {
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut slow = 0;
    let begun = std::time::Instant::now();
    let mut n = 0;
    for k in 0..10_000 {
        let mut bytes = vec![0; 160];
        rng.fill_bytes(&mut bytes);
        let file = draw::scene_file(&mut draw::Bytes(&bytes));
        let Ok(scene) = Scene::try_from(file) else { continue };
        n += 1;
        let t = std::time::Instant::now();
        draw::survives_on_a_small_basis(&scene);
        let e = t.elapsed().as_secs_f64();
        if e > 0.5 {
            slow += 1;
            let plate = Plate::new(&scene, Resolution { max_diameters: 3, radial_functions: 3 });
            let c: Vec<f64> = SpectralModel::critical_speeds(&plate).unwrap().iter().map(|c| c.speed_rad_per_s).collect();
            let top = 1.1 * c[c.len().min(3) - 1];
            let model = SpectralModel::new(plate, (0.0, top), Strategy::Dense).unwrap();
            let ch = chart(&model, (0.0, top), 5, &|_, _| ()).unwrap();
            println!("{k} {e:.2}s damped {} free {} crit {:?} bands {} checked {} viol {} gave up {} guides {:?}", !model.is_conservative(), model.parts[0].full.free_rigid.len(), &c[..c.len().min(4)], ch.instabilities.len(), ch.certificate.speeds_checked, ch.certificate.violations.len(), ch.certificate.gave_up, scene.guides.iter().map(|g| (g.stiffness_n_per_m, g.damping_n_s_per_m)).collect::<Vec<_>>());
        }
        if begun.elapsed().as_secs() > 100 { break; }
    }
    println!("{n} scenes, {slow} slow, {:?}", begun.elapsed());
}
