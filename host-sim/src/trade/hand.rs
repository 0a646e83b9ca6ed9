//! A box in the corner of floor and wall, in a hand that moves like a person's: a path generated from a seed, or a recorded one
//! scaled to the size of the corner. SI units, world frame.

use std::f64::consts::TAU;
use std::ops::Range;
use std::path::Path;

use stiction_core::{Angle, Hand};
use stiction_live::number::Number;
use stiction_live::scenes;
use stiction_scene::{HandPath, InputError, Placement, Sample, SceneFile, Source};

use super::random::Random;

/// The scene: the corner of a bundled one, with the box elsewhere. The hand holds the box above its middle, which is at (0.05, 0.05) when
/// it lies in the corner.
pub(super) fn scene() -> Result<SceneFile, InputError> {
    let bundled = scenes::find(Path::new("corner-stick-slip"));
    let text = bundled.as_ref().map_or("", Source::text);
    let mut scene = SceneFile::parse(Source::new("hand.toml", text), Number::F32.limit())?;
    scene.written.start = [0.10, 0.10, 0.0];
    Ok(scene)
}

/// The range of the hand (m), in x and y: up to 20 mm into floor and wall.
const REGION: Range<f64> = 0.03..0.15;
/// The range of its angle (rad).
const TURN: Range<f64> = -0.5..0.5;
/// Samples per second, as of a motion capture.
const SAMPLES: f64 = 100.0;
/// The longest accepted recording (s).
const LONGEST: f64 = 600.0;

/// A hand that reaches from place to place with the least jerk (Flash, Hogan 1985), rests, and trembles by 0.1 mm.
pub(super) fn synthetic(seconds: f64) -> HandPath {
    let mut random = Random::new(1);
    let mut reach = Reach::new(&mut random, [0.10, 0.12, 0.0], 0.0);
    let mut samples = Vec::new();
    for k in 0..=(seconds * SAMPLES) as u32 {
        let t = f64::from(k) / SAMPLES;
        if t > reach.begin + reach.duration + reach.rest {
            reach = Reach::new(&mut random, reach.to, t);
        }
        let [x, y, phi] = reach.at(t);
        let tremor = |hertz: f64, phase: f64| 1e-4 * (TAU * hertz * t + phase).sin();
        let hand = Hand::new(
            x + tremor(9.1, 0.0),
            y + tremor(10.3, 1.0),
            phi + 20.0 * tremor(8.3, 2.0),
        );
        samples.push(Sample { t, hand });
    }
    HandPath::new(samples)
}

struct Reach {
    from: [f64; 3],
    to: [f64; 3],
    begin: f64,
    duration: f64,
    rest: f64,
}

impl Reach {
    fn new(random: &mut Random, from: [f64; 3], begin: f64) -> Self {
        Self {
            from,
            to: [REGION, REGION, TURN].map(|range| random.within(range)),
            begin,
            duration: random.within(0.4..1.2),
            rest: random.within(0.0..0.3),
        }
    }

    /// x, y (m), phi (rad)
    fn at(&self, t: f64) -> [f64; 3] {
        let s = ((t - self.begin) / self.duration).clamp(0.0, 1.0);
        let part = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
        std::array::from_fn(|k| self.from[k] + (self.to[k] - self.from[k]) * part)
    }
}

/// A recorded path, moved and scaled so that it fills the region, its mean angle 0.
pub(super) fn recorded(file: &Path) -> Result<HandPath, InputError> {
    let path = HandPath::read(file, &Placement::default())?;
    let samples: Vec<Sample> = path.frames(None).collect();
    let seconds = samples.last().map_or(0.0, |last| last.t - samples[0].t);
    if seconds > LONGEST {
        let problem = format!("is {seconds:.0} s long, allowed: up to {LONGEST} s");
        return Err(Source::new(file, "").error(problem));
    }
    let good: Vec<&Hand<f64>> = (samples.iter().map(|sample| &sample.hand))
        .filter(|hand| hand.is_finite())
        .collect();
    let ends = |axis: usize| {
        let values = good.iter().map(|hand| hand.position[axis]);
        values.fold((f64::MAX, f64::MIN), |(low, high), x| {
            (low.min(x), high.max(x))
        })
    };
    let ((left, right), (bottom, top)) = (ends(0), ends(1));
    let extent = (right - left).max(top - bottom);
    let scale = if extent > 0.0 {
        (REGION.end - REGION.start) / extent
    } else {
        1.0
    };
    let mean = good.iter().map(|hand| hand.angle.radians()).sum::<f64>() / good.len() as f64;
    let placed = |hand: &Hand<f64>| Hand {
        position: [
            REGION.start + scale * (hand.position[0] - left),
            REGION.start + scale * (hand.position[1] - bottom),
        ],
        angle: Angle::from_radians(hand.angle.radians() - mean),
        ..*hand
    };
    let placed = samples.iter().map(|sample| Sample {
        hand: placed(&sample.hand),
        ..*sample
    });
    Ok(HandPath::new(placed.collect()))
}
