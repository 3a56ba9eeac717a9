//! Results at the speeds that a search has computed for an undamped blade.

use std::sync::Mutex;

use faer::c64;

use super::signature::Signature;
use crate::modes::{Mode, smallest};

/// Results at the computed speeds of a search.
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

    /// The signature at a speed, if it was computed.
    pub fn signature(&self, speed_rad_per_s: f64) -> Option<Signature> {
        self.at(speed_rad_per_s, |seen| Some(seen.signature.clone()))
    }

    /// The growing or decaying modes at a speed nearest to two eigenvalues, if the speed was computed.
    pub fn nearest(&self, speed_rad_per_s: f64, lambdas: [c64; 2]) -> Option<[Mode; 2]> {
        self.at(speed_rad_per_s, |seen| {
            let nearest = |lambda: c64| {
                let modes = &seen.coalesced;
                smallest(modes, |mode| (mode.lambda - lambda).norm()).cloned()
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
