use sawflutter::{plate::*, scene::*, spectrum::*};
use std::time::Instant;
fn main() {
    let scene = Scene::paper();
    let range = (0.0, rad_per_s(3000.0));
    let model = SpectralModel::new(
        Plate::new(&scene, Resolution::of(Accuracy::Design)),
        range,
        Strategy::Reduced,
    )
    .unwrap();
    let s = rad_per_s(2262.0);
    let t = Instant::now();
    for _ in 0..20 {
        std::hint::black_box(model.low_modes(s).unwrap());
    }
    println!("low_modes {:?}", t.elapsed() / 20);
    let t = Instant::now();
    for _ in 0..20 {
        std::hint::black_box(model.modes(s).unwrap());
    }
    println!("modes {:?}", t.elapsed() / 20);
    let m = model.modes(s).unwrap();
    let t = Instant::now();
    for _ in 0..20 {
        std::hint::black_box(model.describe(s, m.clone()));
    }
    println!("describe {:?}", t.elapsed() / 20);
    let t = Instant::now();
    for _ in 0..5 {
        std::hint::black_box(lowest_eigenpairs(&model.parts[0].full, s, 14, 100.0));
    }
    println!("lowest14 {:?}", t.elapsed() / 5);
    let t = Instant::now();
    for _ in 0..5 {
        std::hint::black_box(critical_speeds(&model.parts[0].full, &[]).unwrap());
    }
    println!("critical {:?}", t.elapsed() / 5);
}
