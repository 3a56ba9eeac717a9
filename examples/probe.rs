use sawflutter::{plate::*, scene::*, spectrum::*};
fn main() {
    let scene = Scene::paper();
    for (label, res) in [
        ("draft", Resolution::of(Accuracy::Draft)),
        ("design", Resolution::of(Accuracy::Design)),
        ("ref", Resolution::of(Accuracy::Reference)),
    ] {
        let t = std::time::Instant::now();
        let plate = Plate::new(&scene, res);
        let t1 = t.elapsed();
        let top = rad_per_s(3000.0);
        let model = SpectralModel::new(plate, (0.0, top), Strategy::Reduced).unwrap();
        let t2 = t.elapsed();
        println!(
            "{label} N={} r={} plate {t1:?} model {t2:?} window {:.2} Hz, {:?}",
            model.plate.degrees_of_freedom(),
            model.parts[0].reduced.order(),
            model.complete_to_rad_per_s / 6.2831853,
            model.counters
        );
        println!(
            "critical {:?}",
            model
                .critical
                .iter()
                .take(8)
                .map(|c| (rpm(c.speed_rad_per_s), c.diameters))
                .collect::<Vec<_>>()
        );
        for speed in [0.0, 1905.0, 2262.0, 2398.0, 2900.0] {
            let t = std::time::Instant::now();
            let m = model.modes(rad_per_s(speed)).unwrap();
            let t1 = t.elapsed();
            let d = model.describe(rad_per_s(speed), m);
            println!(
                "{speed} rpm {t1:?} {:?} index {}",
                t.elapsed(),
                model.negative_stiffness_directions(rad_per_s(speed))
            );
            for d in d.iter().take(14) {
                println!(
                    "   {:9.4} Hz {:9.4} 1/s {:?} slope {:.3} {} be {:.1e}",
                    d.mode.lambda.im / 6.283185307,
                    d.mode.lambda.re,
                    d.mode.kind,
                    d.mode.frequency_slope,
                    in_words(d.name.diameters, d.name.circles, d.name.direction),
                    d.backward_error
                );
            }
        }
    }
}
