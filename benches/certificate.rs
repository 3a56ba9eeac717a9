//! Run times of the Krein certificate and of the sweep that it certifies: `cargo bench --bench certificate`.
//!
//! The certificate adds the symmetric eigenproblem of the critical speeds on the full model; the comparison of two
//! counts at each speed takes negligible time.

mod timing;

use std::hint::black_box;

use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Scene, SpeedRange};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::chart;

use timing::time;

fn main() {
    let plate = || Plate::new(&Scene::paper(), Resolution::of(Accuracy::Design));
    let whole = plate();
    time("certificate", 10, || {
        let critical = SpectralModel::critical_speeds(&whole);
        black_box(critical.expect("critical speeds"));
    });
    let range = SpeedRange::between_rpm(0.0, 3000.0);
    time("sweep", 5, || {
        let model = SpectralModel::new(plate(), range, Strategy::Reduced).expect("a model");
        black_box(chart(&model, range, 101, &|_, _| ()).expect("a chart"));
    });
}
