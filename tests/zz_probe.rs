#[path = "common/draw.rs"]
#[allow(dead_code)]
mod draw;
use proptest::prelude::Rng;
use proptest::test_runner::*;
use sawflutter::scene::*;
#[test]
fn probe() {
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut scenes = vec![];
    for _ in 0..200 {
        let mut bytes = vec![0; 160];
        rng.fill_bytes(&mut bytes);
        if let Ok(scene) = Scene::try_from(draw::scene_file(&mut draw::Bytes(&bytes))) {
            scenes.push(scene);
        }
    }
    scenes.truncate(40);
    for seq in [true, false] {
        if seq {
            faer::set_global_parallelism(faer::Par::Seq)
        } else {
            faer::set_global_parallelism(faer::Par::rayon(0))
        }
        let t = std::time::Instant::now();
        for s in &scenes {
            draw::survives_chart(s);
        }
        println!("seq {seq}: {:?} for {}", t.elapsed(), scenes.len());
        let t = std::time::Instant::now();
        for s in scenes.iter().take(4) {
            draw::survives_analysis(s);
        }
        println!("seq {seq}: full {:?}", t.elapsed());
    }
}
