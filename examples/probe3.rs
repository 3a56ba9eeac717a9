use faer::{Mat, linalg::solvers::Eigen};
fn main() {
    for n in [40usize, 60, 90, 130, 174, 264] {
        let a = Mat::from_fn(n, n, |i, j| {
            ((i * 31 + j * 17) as f64 * 0.37).sin() + if i == j { 3.0 } else { 0.0 }
        });
        let reps = 10;
        let t = std::time::Instant::now();
        for _ in 0..reps {
            std::hint::black_box(Eigen::new_from_real(a.as_ref()).unwrap());
        }
        let v = t.elapsed() / reps;
        let t = std::time::Instant::now();
        for _ in 0..reps {
            std::hint::black_box(a.eigenvalues().unwrap());
        }
        let w = t.elapsed() / reps;
        println!("{n}: vectors {v:?} values {w:?} ");
    }
}
