//! Cost of the Krein certificate, beside the sweep that it certifies: `cargo bench`.
//!
//! What the certificate adds is the symmetric eigenproblem of the critical speeds on the
//! whole basis; comparing two counts at each speed is free.

use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, Scene, rad_per_s};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::chart;

fn main() {
    divan::main();
}

fn plate() -> Plate {
    Plate::new(&Scene::paper(), Resolution::of(Accuracy::Design))
}

#[divan::bench(sample_count = 10)]
fn certificate(bencher: divan::Bencher<'_, '_>) {
    let plate = plate();
    bencher.bench_local(|| SpectralModel::critical_speeds(&plate));
}

#[divan::bench(sample_count = 5)]
fn sweep(bencher: divan::Bencher<'_, '_>) {
    let range = (0.0, rad_per_s(3000.0));
    bencher.bench_local(|| {
        let model = SpectralModel::new(plate(), range, Strategy::Reduced)?;
        chart(&model, range, 101, &|_, _| ())
    });
}
