use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, Scene, rad_per_s};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{chart, undamped_bands};
use std::time::Instant;
fn main() {
    let name = std::env::args().nth(1).unwrap_or_default();
    let acc = match name.as_str() { "draft" => Accuracy::Draft, "reference" => Accuracy::Reference, _ => Accuracy::Design };
    let range = (0.0, rad_per_s(3000.0));
    let t = Instant::now();
    let plate = Plate::new(&Scene::paper(), Resolution::of(acc));
    println!("plate {:?}", t.elapsed());
    let t = Instant::now();
    let c = SpectralModel::critical_speeds(&plate).unwrap();
    println!("critical {:?} in range {}", t.elapsed(), c.iter().filter(|c| c.speed_rad_per_s < range.1).count());
    let t = Instant::now();
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    println!("model {:?}", t.elapsed());
    let p = &model.parts[0];
    println!("chart pieces {:?} height {} Hz; low {:?} {} Hz", p.chart.iter().map(|c| c.basis.ncols()).collect::<Vec<_>>(), model.complete_to_rad_per_s/6.283, p.low.as_ref().map(|l| l.0.basis.ncols()), p.low.as_ref().map(|l| l.1).unwrap_or(0.0)/6.283);
    println!("{:?}", model.counters);
    let t = Instant::now();
    let (b, cert) = undamped_bands(&model, range, 101).unwrap();
    println!("bands {:?}: {} checked {}", t.elapsed(), b.len(), cert.speeds_checked);
    println!("{:?}", model.counters);
    for b in &b { println!("{:?} {:.9} {:.9} {:.6} at {:.3}", b.kind, sawflutter::scene::rpm(b.from), sawflutter::scene::rpm(b.to), b.peak_growth_per_s, sawflutter::scene::rpm(b.peak)); }
    let t = Instant::now();
    let c = chart(&model, range, 101, &|_, _| ()).unwrap();
    println!("chart {:?} samples {} modes {}", t.elapsed(), c.campbell.samples.len(), c.campbell.samples[5].modes.len());
    println!("{:?}", model.counters);
}
