//! Speeds of an undamped blade that a search has computed.

use std::sync::Mutex;

use faer::c64;

use super::signature::Signature;
use crate::spectrum::Mode;

/// Computed speeds of a search.
#[derive(Debug, Default)]
pub struct Seen {
    speeds: Mutex<Vec<SeenSpeed>>,
}

#[derive(Debug)]
struct SeenSpeed {
    signature: Signature,
    /// Growing and decaying modes.
    coalesced: Vec<Mode>,
}

impl Seen {
    /// Stores the signature of a speed and its growing and decaying modes.
    pub fn add(&self, signature: Signature, coalesced: Vec<Mode>) {
        if let Ok(mut speeds) = self.speeds.lock() {
            speeds.push(SeenSpeed {
                signature,
                coalesced,
            });
        }
    }

    /// The signature of a speed.
    pub fn signature(&self, speed_rad_per_s: f64) -> Option<Signature> {
        self.at(speed_rad_per_s, |seen| Some(seen.signature.clone()))
    }

    /// Growing and decaying modes of a speed nearest to two eigenvalues.
    pub fn nearest(&self, speed_rad_per_s: f64, lambdas: [c64; 2]) -> Option<[Mode; 2]> {
        self.at(speed_rad_per_s, |seen| {
            let nearest = |lambda: c64| {
                let away = |mode: &&Mode| (mode.lambda - lambda).norm();
                let modes = seen.coalesced.iter();
                modes.min_by(|x, y| away(x).total_cmp(&away(y))).cloned()
            };
            Some([nearest(lambdas[0])?, nearest(lambdas[1])?])
        })
    }

    /// Signatures at all speeds, ascending.
    pub fn signatures(&self) -> Vec<Signature> {
        let Ok(speeds) = self.speeds.lock() else {
            return Vec::new();
        };
        let mut all: Vec<Signature> = speeds.iter().map(|seen| seen.signature.clone()).collect();
        all.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        all
    }

    fn at<T>(&self, speed_rad_per_s: f64, read: impl Fn(&SeenSpeed) -> Option<T>) -> Option<T> {
        let speeds = self.speeds.lock().ok()?;
        let is_there = |seen: &&SeenSpeed| seen.signature.speed_rad_per_s == speed_rad_per_s;
        speeds.iter().find(is_there).and_then(read)
    }
}
