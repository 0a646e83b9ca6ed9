//! A door that squeaks, as a WAV file: the pin of its hinge rubs in its bushing, sticks and slips, and what the friction does to the leaf
//! sounds. The solver makes a step with every sample, 48 000 a second, in f32; a bank of resonators is the leaf.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example squeak -- squeak.wav
//! ```
//!
//! The pitch is no number of the file but follows from the contact. The hand (the hinge that turns) goes on with speed v while the pin
//! sticks, so that the spring k loads by k v a second, until the friction is `mu_s` N. The pin slips, and the slip ends at `mu_d` N: the
//! force has dropped by (`mu_s` - `mu_d`) N, which takes the time (`mu_s` - `mu_d`) N / (k v) to come back. The slips, and the tone, have the
//! frequency
//!
//! ```text
//! f = k v / ((mu_s - mu_d) N)
//! ```
//!
//! With k = 200 N/mm, N = 20 N, `mu_s` = 0.6 and `mu_d` = 0.4 the force drops by 4 N, a slip is 20 µm long, and 1 mm/s gives 50 Hz. The
//! speed of the door makes the melody; the resonators colour it, and do not tune it.

use std::error::Error;
use std::f64::consts::PI;
use std::io::Error as IoError;
use std::path::Path;

use hound::{SampleFormat, WavSpec, WavWriter};
use stiction_core::{Description, Evolution, Hand, Scene, Solver, SurfaceDescription};

/// Samples, and steps of the solver, a second.
const RATE: u32 = 48_000;
/// The pin as a block: its width and height (m). Small, as f32 resolves 1e-7 of it.
const PIN: [f32; 2] = [0.010, 0.006];
/// Sliding distance over which the contact renews itself (m): much less than the slips, or it would not stick again.
const MEMORY: f32 = 0.5e-6;
/// Opening and closing: how long (s), and the largest speed of the pin's surface (m/s).
const SWINGS: [(f64, f64); 2] = [(2.6, 0.009), (1.8, -0.006)];
/// Modes of the leaf: frequency (Hz), time in which it dies away by e (s), and how strongly the force excites it.
const MODES: [(f64, f64, f64); 6] = [
    (118.0, 0.090, 0.5),
    (287.0, 0.060, 0.7),
    (640.0, 0.035, 1.0),
    (1180.0, 0.022, 0.9),
    (2270.0, 0.012, 0.6),
    (3900.0, 0.007, 0.3),
];
/// The loudest sample, as a part of what the file can hold.
const PEAK: f64 = 0.9;

/// What rubs.
#[derive(Clone, Copy, Debug)]
struct Rub {
    /// k (N/m).
    stiffness: f32,
    /// N (N).
    press: f32,
    /// `mu_s` and `mu_d`.
    friction: [f32; 2],
}

/// The pin in its bushing.
const HINGE: Rub = Rub {
    stiffness: 2e5,
    press: 20.0,
    friction: [0.6, 0.4],
};

/// The friction over time.
#[derive(Debug)]
struct Rubbing {
    /// On the pin, at every sample (N).
    force: Vec<f32>,
    /// The samples at which it slipped.
    slips: Vec<usize>,
}

impl Rub {
    /// The frequency of the slips at a speed (m/s): k v / ((`mu_s` - `mu_d`) N).
    fn pitch(&self, speed: f64) -> f64 {
        let [fastest, slowest] = self.friction.map(f64::from);
        f64::from(self.stiffness) * speed.abs() / ((fastest - slowest) * f64::from(self.press))
    }

    /// A block on a floor. It is held in the plane of the contact, so that friction does not tip it, and the spring alone presses it.
    fn solver(&self) -> Result<Solver<f32, 4, 1>, Box<dyn Error>> {
        let [x, y] = PIN.map(|side| side / 2.0);
        let [friction_static, friction_dynamic] = self.friction;
        let scene = Scene::<f32, 4, 1>::new(&Description {
            vertices: &[[-x, -y], [x, -y], [x, y], [-x, y]],
            start: [0.0, y, 0.0],
            weight: 0.0,
            holding_point: Some([0.0, -y]),
            reach: 0.0,
            stiffness_translation: self.stiffness,
            stiffness_rotation: 1.0,
            surfaces: &[SurfaceDescription {
                normal: [0.0, 1.0],
                offset: 0.0,
                friction_static,
                friction_dynamic,
                memory: Some(MEMORY),
            }],
        })
        .map_err(|error| error.to_string())?;
        Ok(Solver::new(scene, Evolution::Path))
    }

    /// Rubs along a path: where the hand is at every sample (m).
    fn along(&self, path: impl Iterator<Item = f64>) -> Result<Rubbing, Box<dyn Error>> {
        let solver = self.solver()?;
        // N = k times the depth of the hand below the contact.
        let depth = self.press / self.stiffness;
        let (mut state, _) = solver.start(Hand::new(0.0, -depth, 0.0));
        let mut rubbing = Rubbing {
            force: Vec::new(),
            slips: Vec::new(),
        };
        for (sample, x) in path.enumerate() {
            let output = solver.step(&mut state, Hand::new(x as f32, -depth, 0.0));
            let contacts = solver.contacts(&state);
            rubbing
                .force
                .push(contacts.iter().map(|contact| contact.friction).sum());
            if output.slips > 0 {
                rubbing.slips.push(sample);
            }
        }
        Ok(rubbing)
    }
}

/// The path of the pin's surface as the door opens and closes: slow, fast, slow.
fn swings() -> impl Iterator<Item = f64> {
    let speeds = SWINGS.into_iter().flat_map(|(seconds, most)| {
        let samples = (seconds * f64::from(RATE)) as u32;
        (0..samples).map(move |k| most * (PI * f64::from(k) / f64::from(samples)).sin().powi(2))
    });
    speeds.scan(0.0, |x, speed| {
        *x += speed / f64::from(RATE);
        Some(*x)
    })
}

/// One mode: y'' + 2 y' / tau + w² y = force, at the samples as it is exactly for impulses.
#[derive(Debug)]
struct Mode {
    /// Of the last sample and the one before.
    feedback: [f64; 2],
    gain: f64,
    last: [f64; 2],
}

impl Mode {
    fn new((frequency, decay, gain): (f64, f64, f64)) -> Self {
        let fall = (-1.0 / (decay * f64::from(RATE))).exp();
        let turn = 2.0 * PI * frequency / f64::from(RATE);
        Self {
            feedback: [2.0 * fall * turn.cos(), -fall * fall],
            gain: gain * turn.sin(),
            last: [0.0; 2],
        }
    }

    fn next(&mut self, kick: f64) -> f64 {
        let [a, b] = self.feedback;
        let [one, two] = self.last;
        let y = a * one + b * two + self.gain * kick;
        self.last = [y, one];
        y
    }
}

/// The sound of a force: the leaf rings where it changes. The loudest sample is [`PEAK`].
fn sound(force: &[f32]) -> Vec<f64> {
    let mut modes = MODES.map(Mode::new);
    let mut ring: Vec<f64> = force
        .windows(2)
        .map(|pair| {
            let kick = f64::from(pair[1]) - f64::from(pair[0]);
            modes.iter_mut().map(|mode| mode.next(kick)).sum()
        })
        .collect();
    let loudest = ring
        .iter()
        .fold(f64::MIN_POSITIVE, |most, y| most.max(y.abs()));
    ring.iter_mut().for_each(|y| *y *= PEAK / loudest);
    ring
}

/// Writes 16 bit, mono.
fn write(file: &Path, sound: &[f64]) -> Result<(), hound::Error> {
    let spec = WavSpec {
        channels: 1,
        sample_rate: RATE,
        bits_per_sample: 16,
        sample_format: SampleFormat::Int,
    };
    let mut writer = WavWriter::create(file, spec)?;
    for y in sound {
        writer.write_sample((y * f64::from(i16::MAX)).round() as i16)?;
    }
    writer.finalize()
}

fn main() -> Result<(), Box<dyn Error>> {
    let missing = || IoError::other("no file, allowed: squeak -- squeak.wav");
    let file = std::env::args_os().nth(1).ok_or_else(missing)?;
    let rubbing = HINGE.along(swings())?;
    write(Path::new(&file), &sound(&rubbing.force))?;
    let most = SWINGS.map(|(_, speed)| HINGE.pitch(speed));
    println!(
        "{}: {} slips, up to {:.0} Hz as it opens and {:.0} Hz as it closes",
        file.display(),
        rubbing.slips.len(),
        most[0],
        most[1]
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One second at a speed (m/s).
    fn second(rub: &Rub, speed: f64) -> Rubbing {
        let path = (1..=RATE).map(|k| speed * f64::from(k) / f64::from(RATE));
        rub.along(path).expect("a scene")
    }

    /// Power of a sound at a frequency (Hz), in a Hann window.
    fn power(sound: &[f64], frequency: f64) -> f64 {
        let step = 2.0 * PI / sound.len() as f64;
        let (mut re, mut im) = (0.0, 0.0);
        for (k, y) in sound.iter().enumerate() {
            let windowed = y * (1.0 - (step * k as f64).cos());
            let (sin, cos) = (2.0 * PI * frequency * k as f64 / f64::from(RATE)).sin_cos();
            re += windowed * cos;
            im += windowed * sin;
        }
        re * re + im * im
    }

    #[test]
    fn slips_come_as_often_as_the_formula_says() {
        for (press, friction, stiffness, speed) in [
            (20.0, [0.6, 0.4], 2e5, 0.0073),
            (10.0, [0.6, 0.4], 2e5, -0.0041),
            (20.0, [0.5, 0.2], 2e5, 0.009),
            (20.0, [0.6, 0.4], 1e5, 0.006),
        ] {
            let rub = Rub {
                stiffness,
                press,
                friction,
            };
            let slips = second(&rub, speed).slips;
            let (first, last) = (slips[0], slips[slips.len() - 1]);
            let rate = (slips.len() - 1) as f64 * f64::from(RATE) / (last - first) as f64;
            let wanted = rub.pitch(speed);
            // Both ends are known to a sample.
            assert!(
                (rate / wanted - 1.0).abs() < 2e-3,
                "{rate} Hz, {wanted} Hz by the formula"
            );
        }
    }

    #[test]
    fn the_tone_has_that_pitch_and_its_multiples() {
        let speed = 0.0073;
        let rubbing = second(&HINGE, speed);
        let sound = sound(&rubbing.force);
        let at = |multiple: f64| power(&sound, multiple * HINGE.pitch(speed));
        for multiple in 1..=6 {
            let tone = at(f64::from(multiple));
            let between = at(f64::from(multiple) + 0.5);
            assert!(
                tone > 300.0 * between,
                "multiple {multiple}: {tone}, half a multiple higher {between}"
            );
        }
    }

    #[test]
    fn the_file_holds_the_whole_swing() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("squeak.wav");
        let force = HINGE.along(swings()).expect("a scene").force;
        write(&file, &sound(&force)).expect("a file");
        let mut reader = hound::WavReader::open(&file).expect("a WAV file");
        let spec = reader.spec();
        assert_eq!(
            (spec.channels, spec.sample_rate, spec.bits_per_sample),
            (1, 48_000, 16)
        );
        let samples: Vec<i16> = reader.samples().map(|y| y.expect("a sample")).collect();
        let seconds: f64 = SWINGS.iter().map(|(seconds, _)| seconds).sum();
        assert!((samples.len() as f64 / 48e3 - seconds).abs() < 1e-3);
        let loudest = samples.iter().map(|y| y.unsigned_abs()).max();
        assert_eq!(loudest, Some((PEAK * 32_767.0_f64).round() as u16));
    }
}
