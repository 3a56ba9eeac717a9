//! Run times of the potential of stretching on the basis of accuracy `design`, of its quartic form on 30 shapes, and of
//! the analyses that use it.

mod timing;

use std::hint::black_box;

use faer::{Col, Mat};
use sawflutter::model::plate::{Plate, ReducedStretching, Resolution, Stretching};
use sawflutter::model::scene::{Accuracy, Polar, Scene, SpeedRange, rad_per_s};
use sawflutter::motion::stretched_blade::{Extent, StretchedBlade};

use timing::time;

fn main() {
    let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Design));
    let order = plate.degrees_of_freedom();
    // The run time does not depend on the shapes, as long as each contains every harmonic.
    let shapes = Mat::from_fn(order, 30, |i, k| {
        ((1 + k) as f64 * (0.7 * i as f64 + 1.0)).sin()
    });
    let stretching = Stretching::new(&plate).expect("a potential");
    let form = || ReducedStretching::new(&stretching, shapes.as_ref()).expect("a form");
    let reduced = form();
    let p = Col::from_fn(30, |k| 1e-3 * k as f64);
    time("relaxed harmonics", 10, || {
        black_box(Stretching::new(&plate).expect("a potential"));
    });
    time("quartic form of 30 shapes", 10, || {
        black_box(form());
    });
    time("its gradient", 100, || {
        black_box(reduced.gradient(&p).expect("a gradient"));
    });
    time("its Hessian", 100, || {
        black_box(reduced.hessian(&p).expect("a Hessian"));
    });
    let blade = StretchedBlade::new(&plate, 30).expect("a blade");
    let (critical, shape) = blade.pitchforks().expect("speeds").swap_remove(0);
    let start = blade.leaned(1.001 * critical, &shape).expect("a lean");
    let range = SpeedRange::new(start.speed_rad_per_s, rad_per_s(3000.0));
    let count = |upwards| {
        blade
            .branch(&start, upwards, range, Extent::Whole)
            .expect("a branch")
            .equilibria
            .len()
    };
    println!("{} equilibria of the leaned blade:", count(true));
    time("up to 3000 rpm", 5, || {
        black_box(count(true));
    });
    let pressed = blade
        .clone()
        .pressed(5.0, Polar::new(0.355, 0.0))
        .expect("a force");
    let speeds: Vec<f64> = (0..100).map(|k| rad_per_s(30.0 * f64::from(k))).collect();
    time("100 equilibria up to 3000 rpm", 5, || {
        let mut p = pressed.flat();
        for speed in &speeds {
            p = pressed
                .settled(*speed, &p)
                .expect("an equilibrium")
                .coordinates;
        }
        black_box(&p);
    });
    time("how far flutter rises at one speed", 5, || {
        let flutter = StretchedBlade::at_speed(&plate, rad_per_s(2872.0), 15).expect("a blade");
        black_box(flutter.saturation(rad_per_s(2872.0)).expect("a pair"));
    });
}
