use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, Scene, rad_per_s};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{chart, undamped_bands};
use std::time::Instant;
fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    if std::env::var("MIND").is_ok() {
        krylov();
    }
    if std::env::var("MIND").is_ok() {
        return;
    }
    let name = std::env::args().nth(1).unwrap_or_default();
    let acc = match name.as_str() {
        "draft" => Accuracy::Draft,
        "reference" => Accuracy::Reference,
        _ => Accuracy::Design,
    };
    let range = (0.0, rad_per_s(3000.0));
    let t = Instant::now();
    let plate = Plate::new(&Scene::paper(), Resolution::of(acc));
    println!("plate {:?}", t.elapsed());
    let t = Instant::now();
    let c = SpectralModel::critical_speeds(&plate).unwrap();
    println!(
        "critical {:?} in range {}",
        t.elapsed(),
        c.iter().filter(|c| c.speed_rad_per_s < range.1).count()
    );
    let t = Instant::now();
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    println!("model {:?}", t.elapsed());
    let p = &model.parts[0];
    println!(
        "chart pieces {:?} height {} Hz; low {:?} {} Hz",
        p.chart.iter().map(|c| c.basis.ncols()).collect::<Vec<_>>(),
        model.complete_to_rad_per_s / 6.283,
        p.low.as_ref().map(|l| l.0.basis.ncols()),
        p.low.as_ref().map(|l| l.1).unwrap_or(0.0) / 6.283
    );
    println!("{:?}", model.counters);
    let t = Instant::now();
    let (b, cert) = undamped_bands(&model, range, 101).unwrap();
    println!(
        "bands {:?}: {} checked {}",
        t.elapsed(),
        b.len(),
        cert.speeds_checked
    );
    println!("{:?}", model.counters);
    for b in &b {
        println!(
            "{:?} {:.9} {:.9} {:.6} at {:.3}",
            b.kind,
            sawflutter::scene::rpm(b.from),
            sawflutter::scene::rpm(b.to),
            b.peak_growth_per_s,
            sawflutter::scene::rpm(b.peak)
        );
    }
    let t = Instant::now();
    let c = chart(&model, range, 51, &|_, _| ()).unwrap();
    println!(
        "chart {:?} samples {} modes {}",
        t.elapsed(),
        c.campbell.samples.len(),
        c.campbell.samples[5].modes.len()
    );
    println!("{:?}", model.counters);
}
#[allow(dead_code)]
pub fn krylov() {
    use sawflutter::spectrum::lowest_eigenpairs;
    let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Design));
    let system = sawflutter::system::GyroscopicSystem::of_plate(&plate);
    for count in [14, 20] {
        for rpm in [0.0, 1000.0, 3000.0] {
            let t = Instant::now();
            let p = lowest_eigenpairs(&system, rad_per_s(rpm), count, 25.0);
            println!("krylov {count} {rpm} {:?} {}", t.elapsed(), p.len());
        }
    }
    let t = Instant::now();
    let l = system.stiffness.llt(faer::Side::Lower).unwrap();
    println!("llt {:?}", t.elapsed());
    let t = Instant::now();
    let _ = faer::linalg::solvers::DenseSolveCore::inverse(&l);
    println!("inverse llt {:?}", t.elapsed());
    let t = Instant::now();
    let lu = system.stiffness.partial_piv_lu();
    println!("lu {:?}", t.elapsed());
    let t = Instant::now();
    let _ = faer::linalg::solvers::DenseSolveCore::inverse(&lu);
    println!("inverse lu {:?}", t.elapsed());
    let t = Instant::now();
    let _ = system
        .stiffness
        .self_adjoint_eigen(faer::Side::Lower)
        .unwrap();
    println!("sym evd {:?}", t.elapsed());
    let t = Instant::now();
    let _ = system
        .stiffness
        .self_adjoint_eigenvalues(faer::Side::Lower)
        .unwrap();
    println!("sym values {:?}", t.elapsed());
    for n in [16, 28, 40, 56, 70, 110] {
        let a = faer::Mat::from_fn(n, n, |i, j| {
            ((i * 7 + j * 13) as f64).sin() + if i == j { i as f64 } else { 0.0 }
        });
        let t = Instant::now();
        for _ in 0..5 {
            let _ = faer::linalg::solvers::Eigen::new_from_real(a.as_ref()).unwrap();
        }
        println!("evd {n} {:?}", t.elapsed() / 5);
        let t = Instant::now();
        for _ in 0..5 {
            let _ = a.eigenvalues().unwrap();
        }
        println!("eigenvalues {n} {:?}", t.elapsed() / 5);
    }
}
