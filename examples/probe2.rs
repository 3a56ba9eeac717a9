use sawflutter::{plate::*, scene::*, spectrum::*, stability};
fn main() {
    let count: usize = std::env::args().nth(1).map_or(101, |s| s.parse().unwrap());
    let acc = match std::env::args().nth(2).as_deref() {
        Some("draft") => Accuracy::Draft,
        Some("reference") => Accuracy::Reference,
        _ => Accuracy::Design,
    };
    let top: f64 = std::env::args()
        .nth(3)
        .map_or(3000.0, |s| s.parse().unwrap());
    let scene = match std::env::args().nth(4) {
        Some(p) => Scene::from_path(p.as_ref()).unwrap(),
        None => Scene::paper(),
    };
    let t = std::time::Instant::now();
    let range = (0.0, rad_per_s(top));
    let model = SpectralModel::new(
        Plate::new(&scene, Resolution::of(acc)),
        range,
        Strategy::Reduced,
    )
    .unwrap();
    let t1 = t.elapsed();
    let chart = stability::chart(&model, range, count, &|_, _| ()).unwrap();
    println!(
        "low {:?} model {t1:?} all {:?} r={:?} {:?} {:?}",
        model.parts[0]
            .low
            .as_ref()
            .map(|l| (l.0.reduced.order(), l.1)),
        t.elapsed(),
        model.parts[0].chart.iter().map(|p| p.reduced.order()).max(),
        model.counters,
        chart.certificate
    );
    for b in &chart.instabilities {
        println!(
            "{:?} {:.6} - {:.6} (width {:.4}) closed {} peak {:.4} 1/s at {:.3} rpm, {:.4} Hz {:?}",
            b.kind,
            rpm(b.from),
            rpm(b.to),
            rpm(b.to - b.from),
            b.closed,
            b.peak_growth_per_s,
            rpm(b.peak),
            b.frequency / 6.283185307,
            b.modes
        );
    }
    println!("branches {}", chart.campbell.branches.len());
}
