//! Slopes of a deflection, and strains of products of slopes, for each harmonic.

/// Real part and imaginary part of a quantity at all nodes.
type Parts = [Vec<f64>; 2];

/// Slopes wₙ′ and i n wₙ/r at the nodes, n = 0 … n_max, or forces on them; those of −n are complex
/// conjugates.
#[derive(Debug, Clone)]
pub struct Slopes {
    /// Radial and hoop slope of each n; `None` where both are zero.
    waves: Vec<Option<[Parts; 2]>>,
    nodes: usize,
}

/// Both slopes of a wave of n nodal diameters, n positive or negative.
struct SlopeWave<'a> {
    n: isize,
    parts: &'a [Parts; 2],
}

impl Slopes {
    /// Zero slopes.
    pub fn none(max_diameters: usize, nodes: usize) -> Self {
        Slopes {
            waves: vec![None; max_diameters + 1],
            nodes,
        }
    }

    /// Sets both slopes of n at a node, each as real and imaginary part.
    pub fn set(&mut self, n: usize, node: usize, radial: [f64; 2], hoop: [f64; 2]) {
        let nodes = self.nodes;
        let zero = || [0, 1].map(|_| vec![0.0; nodes]);
        let wave = self.waves[n].get_or_insert_with(|| [zero(), zero()]);
        for (slope, value) in wave.iter_mut().zip([radial, hoop]) {
            slope[0][node] = value[0];
            slope[1][node] = value[1];
        }
    }

    /// Both slopes of n at a node, each as real and imaginary part.
    pub fn at(&self, n: usize, node: usize) -> [[f64; 2]; 2] {
        match &self.waves[n] {
            Some(wave) => [0, 1].map(|k| [wave[k][0][node], wave[k][1][node]]),
            None => [[0.0; 2]; 2],
        }
    }

    /// Iterates over all n, positive and negative, whose slopes are not zero.
    fn present(&self) -> impl Iterator<Item = SlopeWave<'_>> {
        let waves = self.waves.iter().enumerate();
        waves.flat_map(|(n, wave)| {
            let n = n as isize;
            let both = if n == 0 { 1 } else { 2 };
            wave.iter().flat_map(move |parts| {
                [n, -n]
                    .map(|n| SlopeWave { n, parts })
                    .into_iter()
                    .take(both)
            })
        })
    }
}

/// Strains [ε_rr, ε_θθ, iγ_rθ] at the nodes, m = 0 … 2 n_max, of a product of two deflections, or stresses:
/// the coefficients of e^{imθ}. With the factor i one real stiffness applies to all three.
#[derive(Debug, Clone)]
pub struct Strain {
    /// Real and imaginary part of each m, three values per node: all ε_rr, all ε_θθ, all iγ_rθ.
    pub harmonics: Vec<Parts>,
    nodes: usize,
}

impl Strain {
    /// Zero strains.
    pub fn none(max_order: usize, nodes: usize) -> Self {
        Strain {
            harmonics: vec![[0, 1].map(|_| vec![0.0; 3 * nodes]); max_order + 1],
            nodes,
        }
    }

    /// The strains e(v, w) = ½ sym(∇v ⊗ ∇w): [v′w′/2, v_θ w_θ/2r², (v′w_θ + v_θ w′)/2r].
    pub fn of(v: &Slopes, w: &Slopes) -> Self {
        let mut strain = Strain::none(2 * (v.waves.len() - 1), v.nodes);
        let nodes = v.nodes;
        for left in v.present() {
            for right in w.present() {
                let Ok(m) = usize::try_from(left.n + right.n) else {
                    continue;
                };
                // Slices of one length let the loop go without checks of its indices.
                let [real, imaginary] = &mut strain.harmonics[m];
                let (re_rr, re) = real.split_at_mut(nodes);
                let (re_tt, re_rt) = re.split_at_mut(nodes);
                let (im_rr, im) = imaginary.split_at_mut(nodes);
                let (im_tt, im_rt) = im.split_at_mut(nodes);
                let (re_rt, im_rt) = (&mut re_rt[..nodes], &mut im_rt[..nodes]);
                let [left_sign, right_sign] = [left.n, right.n].map(conjugation);
                let [[vr, vri], [vt, vti]] = of_nodes(left.parts, nodes);
                let [[wr, wri], [wt, wti]] = of_nodes(right.parts, nodes);
                for j in 0..nodes {
                    let (ar, ai) = (0.5 * vr[j], 0.5 * left_sign * vri[j]);
                    let (br, bi) = (0.5 * vt[j], 0.5 * left_sign * vti[j]);
                    let (cr, ci) = (wr[j], right_sign * wri[j]);
                    let (dr, di) = (wt[j], right_sign * wti[j]);
                    re_rr[j] += ar * cr - ai * ci;
                    im_rr[j] += ar * ci + ai * cr;
                    re_tt[j] += br * dr - bi * di;
                    im_tt[j] += br * di + bi * dr;
                    // The third strain, a d + b c, is stored multiplied by i.
                    re_rt[j] -= ar * di + ai * dr + br * ci + bi * cr;
                    im_rt[j] += ar * dr - ai * di + br * cr - bi * ci;
                }
            }
        }
        strain
    }

    /// Forces of these stresses s on the slopes of v, whose work is 4 Σₘ Re(sₘ* eₘ(v, w)), the derivative of
    /// |Z e(w, w)|² in the direction v. Force n is 4 Σₘ wₘ₋ₙ* sₘ/2 over positive and negative m; the work of
    /// n > 0 is twice a real part, because −n has the same work.
    pub fn pulled_back(&self, w: &Slopes) -> Slopes {
        let nodes = self.nodes;
        let mut forces = Slopes::none(w.waves.len() - 1, nodes);
        for n in 0..forces.waves.len() as isize {
            let mut radial = [vec![0.0; nodes], vec![0.0; nodes]];
            let mut hoop = radial.clone();
            for wave in w.present() {
                self.add_force(n + wave.n, &wave, &mut radial, &mut hoop);
            }
            forces.waves[n as usize] = Some([radial, hoop]);
        }
        forces
    }

    /// Adds the force that the stress of harmonic m exerts with a wave of w.
    fn add_force(
        &self,
        m: isize,
        wave: &SlopeWave<'_>,
        [fr, fri]: &mut Parts,
        [ft, fti]: &mut Parts,
    ) {
        let [[wr, wri], [wt, wti]] = wave.parts;
        let nodes = self.nodes;
        let [re, im] = &self.harmonics[m.unsigned_abs()];
        // The stresses of harmonic −m are the complex conjugates of those of m, except that the stored shear
        // iτ also changes its sign. Since m and −m are added separately, each has half the weight of m = 0.
        let share = if m == 0 { 2.0 } else { 1.0 };
        let (side, wave_side) = (conjugation(m), -conjugation(wave.n));
        for j in 0..nodes {
            let (cr, ci) = (share * wr[j], share * wave_side * wri[j]);
            let (dr, di) = (share * wt[j], share * wave_side * wti[j]);
            let (rr, rri) = (re[j], side * im[j]);
            let (tt, tti) = (re[nodes + j], side * im[nodes + j]);
            // The shear stress τ is −i times the stored value iτ.
            let (rt, rti) = (im[2 * nodes + j], side * -re[2 * nodes + j]);
            fr[j] += cr * rr - ci * rri + dr * rt - di * rti;
            fri[j] += cr * rri + ci * rr + dr * rti + di * rt;
            ft[j] += dr * tt - di * tti + cr * rt - ci * rti;
            fti[j] += dr * tti + di * tt + cr * rti + ci * rt;
        }
    }
}

/// Both slopes of a wave at the nodes.
fn of_nodes(parts: &[Parts; 2], nodes: usize) -> [[&[f64]; 2]; 2] {
    let [radial, hoop] = parts;
    [radial, hoop].map(|[real, imaginary]| [&real[..nodes], &imaginary[..nodes]])
}

/// Sign of the imaginary part of wave n relative to the stored one, which is that of |n|.
fn conjugation(n: isize) -> f64 {
    if n < 0 { -1.0 } else { 1.0 }
}
