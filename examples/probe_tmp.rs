use sawflutter::scene::{Scene, rpm};
use sawflutter::stability::ChosenBasis;
fn main() {
    let f = std::env::args().nth(1).unwrap();
    let s = Scene::from_path(f.as_ref()).unwrap();
    let t = std::time::Instant::now();
    let b = ChosenBasis::new(&s, s.tolerance()).unwrap();
    println!(
        "{:?} dof {} range {} {} crit within {} est {}",
        t.elapsed(),
        b.plate.degrees_of_freedom(),
        rpm(b.range.0),
        rpm(b.range.1),
        b.critical
            .iter()
            .filter(|c| c.speed_rad_per_s < b.range.1)
            .count(),
        b.estimated_relative_error
    );
    println!(
        "first {:?}",
        b.critical
            .iter()
            .take(12)
            .map(|c| rpm(c.speed_rad_per_s))
            .collect::<Vec<_>>()
    );
    let m = sawflutter::spectrum::SpectralModel::with_critical(
        b.plate,
        b.critical,
        b.range,
        Default::default(),
    )
    .unwrap();
    println!(
        "{:?} complete {} parts {} low {:?} counters {:?}",
        t.elapsed(),
        m.complete_to_rad_per_s,
        m.parts.len(),
        m.parts
            .iter()
            .map(|p| (
                p.chart.len(),
                p.chart.iter().map(|c| c.basis.ncols()).collect::<Vec<_>>(),
                p.low.as_ref().map(|l| (l.0.basis.ncols(), l.1))
            ))
            .collect::<Vec<_>>(),
        m.counters
    );
}
