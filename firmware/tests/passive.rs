//! Passivity of the whole loop: sine hands move the body of every scene at the largest stiffness that a device admits, and the real
//! controller answers. What the device gives the hand is never more than its damping takes and the springs held before.

use crate::with;
use std::fs;
use std::path::{Path, PathBuf};
use stiction_core::{Hand, Wrench};
use stiction_firmware::device::{
    self, Controller, FromLine, NoActuators, Refusal, Sample, Servo, Settings,
};
use stiction_firmware::safety::{Limits, Passivity};
use stiction_scene::{Motion, SceneFile};
use stiction_tests::station::noise::Random;
use stiction_tests::times;

/// Room for the scenes of the examples.
type Device = Controller<f32, 16, 8, 64>;
type Pose = [f64; 3];

/// Ticks per second, and their period (µs).
const RATE: f64 = 1_000.0;
const PERIOD: u32 = 1_000;
/// What f32 may round the energy of a run by (J): its forces have errors of 1e-6 of 5 N, along ways of decimetres.
const ROUNDING: f64 = 1e-6;

/// A device whose force leaves it this long after the tick that measures the hand (µs).
#[derive(Clone, Copy)]
struct Late {
    turn_us: u32,
    limits: Limits,
}

impl Late {
    fn passivity(self) -> Passivity {
        Passivity {
            damping_translation: 0.5,
            damping_rotation: 0.0005,
            hold_us: PERIOD,
            delay_us: 0,
            turn_us: self.turn_us,
        }
        .at_period(PERIOD)
    }

    fn settings(self) -> Settings {
        Settings {
            limits: self.limits,
            passivity: Some(self.passivity()),
            ..Settings::default()
        }
    }
}

/// The real controller with a hand, and the energies of the way (J).
#[derive(Clone)]
struct Ride {
    device: Late,
    controller: Device,
    servo: Servo<(FromLine, NoActuators)>,
    body: device::Pose,
    stiffness: [f64; 2],
    weight: f64,
    centroid: [f64; 2],
    tick: u32,
    at: Pose,
    /// The hand of the last sample.
    measured: Pose,
    /// Given to the hand, and taken by the damping.
    given: f64,
    taken: f64,
    /// What the weight was lifted and let down by while the force grew after a safe state: it may differ by that, once.
    borne: f64,
    /// The force grows after a safe state.
    grows: bool,
    /// A limit of size has reduced the force.
    limited: bool,
    /// What the weight held at the lowest place of the body (J).
    lowest: f64,
}

impl Ride {
    /// A scene at the largest stiffness that the device admits, the hand at the beginning of its way.
    fn new(scene: &SceneFile, device: Late, at: Pose) -> Result<Self, Refusal> {
        let bounds = device.passivity().bounds();
        let [k_h, k_theta] = bounds.map(|bound| bound * 0.999);
        let (controller, _) = scene.written.described::<f32, _>(|given| {
            let stiffest = with(*given, |given| {
                (given.stiffness_translation, given.stiffness_rotation) = (k_h, k_theta);
            });
            Controller::new(&stiffest, &device.settings())
        });
        Ok(Self {
            device,
            controller: controller?,
            servo: Servo::new((FromLine, NoActuators)),
            body: device::Pose::default(),
            stiffness: [k_h, k_theta].map(f64::from),
            weight: scene.written.weight,
            centroid: centroid(&scene.written.vertices),
            tick: 0,
            at,
            measured: at,
            given: 0.0,
            taken: 0.0,
            borne: 0.0,
            grows: false,
            limited: false,
            lowest: f64::INFINITY,
        })
    }

    /// The hand moves on, in a straight line, in this time (s), under the present force. The damping takes least where it does so evenly.
    fn moves(&mut self, to: Pose, time: f64) {
        let force = self.servo.force();
        let [dx, dy, turn] = std::array::from_fn(|i| to[i] - self.at[i]);
        let [fx, fy] = force.force.map(f64::from);
        self.given += fx * dx + fy * dy + f64::from(force.moment) * turn;
        let damping = self.device.passivity();
        let [along, round] = [damping.damping_translation, damping.damping_rotation].map(f64::from);
        self.taken += (along * (dx * dx + dy * dy) + round * turn * turn) / time;
        self.at = to;
    }

    /// A tick, its turn, and the hand's way until the turn's end and the next tick; without a sample if none comes. `hand`: at a time (s).
    fn turn(&mut self, hand: &impl Fn(f64) -> Pose, comes: bool) {
        let time = |tick: u32| f64::from(tick) / RATE;
        if comes {
            self.measured = hand(time(self.tick));
        }
        let [x, y, phi] = self.measured.map(|x| x as f32);
        let sample = Sample {
            hand: Hand::new(x, y, phi),
            number: self.tick as u16,
            received_us: self.tick * PERIOD,
        };
        let mut left_us = self.device.turn_us;
        self.servo.tick(self.tick * PERIOD);
        // Ticks interrupt a turn.
        while left_us >= PERIOD {
            self.tick += 1;
            self.moves(hand(time(self.tick)), 1.0 / RATE);
            self.servo.tick(self.tick * PERIOD);
            left_us -= PERIOD;
        }
        let late = f64::from(left_us) * 1e-6;
        if left_us > 0 {
            self.moves(hand(time(self.tick) + late), late);
        }
        let turn = self
            .controller
            .turn(comes.then_some(&sample), &mut self.servo);
        let before = std::mem::replace(&mut self.body, turn.pose);
        if turn.flags.rate_limited {
            self.borne += self.weight * (self.height(&self.body) - self.height(&before)).abs();
        }
        self.grows = turn.flags.rate_limited;
        self.limited |= turn.flags.size_limited;
        self.lowest = self.lowest.min(self.weight * self.height(&self.body));
        self.tick += 1;
        self.moves(hand(time(self.tick)), 1.0 / RATE - late);
    }

    /// The energy that the weight and the springs hold (J), as far as these give it: beyond a limit of size they are reduced by
    /// sqrt(most / energy), whose integral over the energy is 2 sqrt(most energy) - most.
    fn stored(&self) -> f64 {
        let state = self.controller.state();
        let wrench = state.map_or(Wrench::default(), |state| {
            self.controller.solver().wrench(state)
        });
        // Since then the hand has moved on.
        let [k_h, k_theta] = self.stiffness;
        let [dx, dy, turn] = std::array::from_fn(|i| self.at[i] - self.measured[i]);
        let [x, y] = wrench.force.map(f64::from);
        let stretch = (x + k_h * dx).hypot(y + k_h * dy);
        let twist = (f64::from(wrench.moment) + k_theta * turn).abs();
        let energy = stretch * stretch / 2.0 / k_h + twist * twist / 2.0 / k_theta;
        let limits = self.controller.settings().limits;
        let [force, moment] = [limits.force, limits.moment].map(f64::from);
        let most = (force * force / 2.0 / k_h).min(moment * moment / 2.0 / k_theta);
        let springs = match energy > most {
            true => 2.0 * (most * energy).sqrt() - most,
            false => energy,
        };
        self.weight * self.height(&self.body) + springs
    }

    /// Counts from here on.
    fn begin(&mut self) {
        (self.given, self.taken, self.borne) = (0.0, 0.0, 0.0);
        self.limited = false;
        self.lowest = self.weight * self.height(&self.body);
    }

    /// What weight and springs may give (J). After a limit has reduced the force, they keep what the hand has not paid for.
    fn own(&self) -> f64 {
        match self.limited {
            true => self.lowest,
            false => self.stored(),
        }
    }

    /// What the hand was given, and may yet be given, beyond what the damping took and `before` (J), which weight and springs held when the
    /// count began.
    fn beyond(&self, before: f64) -> f64 {
        self.given - self.taken - self.borne + self.own() - before
    }

    /// Of the body's centroid (m).
    fn height(&self, body: &device::Pose) -> f64 {
        let (sin, cos) = f64::from(body.angle.radians()).sin_cos();
        let [x, y] = self.centroid;
        f64::from(body.position[1]) + x * sin + y * cos
    }

    /// When the next tick comes (s).
    fn time(&self) -> f64 {
        f64::from(self.tick) / RATE
    }
}

/// The centroid of a convex polygon, a rod or a point.
fn centroid(vertices: &[[f64; 2]]) -> [f64; 2] {
    let ([x0, y0], mut area, mut sum) = (vertices[0], 0.0, [0.0; 2]);
    for pair in vertices.windows(2) {
        let [[ax, ay], [bx, by]] = [pair[0], pair[1]].map(|[x, y]| [x - x0, y - y0]);
        let twice = ax * by - ay * bx;
        area += twice;
        sum = [
            sum[0] + twice * (ax + bx) / 3.0,
            sum[1] + twice * (ay + by) / 3.0,
        ];
    }
    if area == 0.0 {
        let count = vertices.len() as f64;
        let mean = |i: usize| vertices.iter().map(|v| v[i]).sum::<f64>() / count;
        return [mean(0), mean(1)];
    }
    [x0 + sum[0] / area, y0 + sum[1] / area]
}

/// The scenes of the examples and of the boards.
fn scenes() -> Vec<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<_> = ["scenes", "../host-sim/scenes"]
        .into_iter()
        .flat_map(|folder| fs::read_dir(here.join(folder)).unwrap())
        .map(|file| file.unwrap().path())
        .filter(|file| file.extension().is_some_and(|end| end == "toml"))
        .collect();
    files.sort();
    files
}

/// The way of a scene's hand, tick by tick; or down onto the box of a board.
fn way(scene: &SceneFile) -> Vec<Pose> {
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        return (0..400)
            .map(|i| [0.0, 0.05 - 0.006 * f64::from(i) / 400.0, 0.0])
            .collect();
    };
    path.frames(Some(RATE))
        .map(|sample| {
            let [x, y] = sample.hand.position;
            [x, y, sample.hand.angle.radians()]
        })
        .collect()
}

/// 0 to 1.
fn part(random: &mut Random) -> f64 {
    random.bits() as f64 / f64::from(u32::MAX)
}

/// A sine hand about a pose from a time on (s): 1 to 25 Hz, up to 10 mm and 0.1 rad, along a line or an ellipse. Also its frequency.
fn sine(random: &mut Random, about: Pose, from: f64) -> (f64, impl Fn(f64) -> Pose + use<>) {
    let frequency = 25.0_f64.powf(part(random));
    let size = 10.0_f64.powf(-part(random));
    let amplitude = [0.01, 0.01, 0.1].map(|most| most * size * (2.0 * part(random) - 1.0));
    let phase = [0.0; 3].map(|_: f64| part(random) * std::f64::consts::TAU);
    let is_line = random.bits() & 1 == 0;
    let hand = move |time: f64| {
        let angle = (time - from) * frequency * std::f64::consts::TAU;
        std::array::from_fn(|i| {
            let phase = if is_line { phase[0] } else { phase[i] };
            about[i] + amplitude[i] * ((angle + phase).sin() - phase.sin())
        })
    };
    (frequency, hand)
}

/// Every scene, from several places of the way of its hand: passes the ride up to there and where the hand is.
fn from_everywhere(device: Late, places: usize, mut go: impl FnMut(&str, &Ride, Pose)) {
    for file in scenes() {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = SceneFile::read(&file, f64::from(f32::MAX)).unwrap();
        let way = way(&scene);
        let on_way = |time: f64| way[((time * RATE).round() as usize).min(way.len() - 1)];
        let mut ride = Ride::new(&scene, device, way[0]).unwrap();
        for place in 1..=places {
            let until = place * (way.len() - 1) / places;
            while (ride.tick as usize) < until {
                ride.turn(&on_way, true);
            }
            go(&name, &ride, on_way(ride.time()));
        }
    }
}

/// The hands of a test: places on the way of every scene, and hands from each of them.
fn hands() -> (usize, usize) {
    times((4, 5), (20, 10))
}

/// The worst ride: what the hand got beyond what it may get (J), and where.
struct Worst(f64, String);

impl Worst {
    fn new() -> Self {
        Self(f64::NEG_INFINITY, String::new())
    }

    fn see(&mut self, beyond: f64, place: impl FnOnce() -> String) {
        if beyond > self.0 {
            *self = Self(beyond, place());
        }
    }
}

/// By the proof in `safety/limits.rs`: at the largest stiffness, with turns in time, late, and longer than a tick; without limits of size,
/// and with those of the example, which most hands reach.
#[test]
fn sine_hands_are_given_no_more_than_the_damping_takes_in_any_scene() {
    let (places, hands) = hands();
    let unlimited = with(Limits::default(), |limits| {
        (limits.force, limits.moment) = (1e3, 1e3);
        (limits.force_rate, limits.moment_rate) = (1e6, 1e6);
    });
    for (turn_us, limits) in [
        (0, unlimited),
        (675, unlimited),
        (1_000, unlimited),
        (2_100, unlimited),
        (0, Limits::default()),
        (675, Limits::default()),
        (1_000, Limits::default()),
        (2_100, Limits::default()),
    ] {
        let device = Late { turn_us, limits };
        let (mut random, mut worst, mut rides) = (Random(1), Worst::new(), 0);
        from_everywhere(device, places, |scene, ride, at| {
            for _ in 0..hands {
                let mut ride = ride.clone();
                ride.begin();
                let (before, from) = (ride.stored(), ride.time());
                let (frequency, hand) = sine(&mut random, at, from);
                // At a limit, a little in each cycle adds up.
                let cycles = if limits == unlimited { 2.0 } else { 8.0 };
                while ride.time() < from + cycles / frequency {
                    ride.turn(&hand, true);
                }
                let given = ride.given;
                worst.see(ride.beyond(before), || {
                    format!("{scene}, {frequency} Hz: given {given} J")
                });
                rides += 1;
            }
        });
        println!(
            "{turn_us} µs, {} N: {rides} rides, {} J: {}",
            limits.force, worst.0, worst.1
        );
        assert!(
            worst.0 <= ROUNDING,
            "{turn_us} µs, {}: {} J",
            worst.1,
            worst.0
        );
    }
}

/// After so many times 50 cycles, of a hand in 1200, and mostly within 100 cycles, nothing is given any more. Until then it is given, once and in ever
/// smaller parts, what springs and weight held at first.
const SETTLES: usize = 40;

/// A limit of size reduces the force with which a weight is lifted. Let down with more, it would give energy in each cycle.
#[test]
fn sine_hands_that_lift_a_weight_at_a_limit_are_given_nothing_cycle_for_cycle() {
    let (places, hands) = hands();
    for turn_us in [0, 675, 2_100] {
        let device = Late {
            turn_us,
            limits: Limits::default(),
        };
        let (mut random, mut worst, mut rides) = (Random(3), Worst::new(), 0);
        from_everywhere(device, places, |scene, ride, at| {
            for _ in 0..if ride.weight > 0.0 { hands } else { 0 } {
                let mut ride = ride.clone();
                let hand = sine(&mut random, at, ride.time());
                // Whole turns of the solver, of three ticks at most, make a cycle.
                let ticks = (40.0 * 10.0_f64.powf(part(&mut random))).round() * 3.0;
                let from = ride.time();
                let slow = |time: f64| hand.1(from + (time - from) * RATE / ticks / hand.0);
                let mut cycles = |count: f64| {
                    ride.begin();
                    let until = ride.time() + (count * ticks - 0.5) / RATE;
                    while ride.time() < until {
                        ride.turn(&slow, true);
                    }
                    (ride.given - ride.taken) / count
                };
                let (first, mut last) = (cycles(100.0), cycles(20.0));
                for _ in 0..SETTLES {
                    if last > ROUNDING {
                        last = cycles(50.0);
                    }
                }
                worst.see(last, || format!("{scene}, {ticks} ms, {first} J at first"));
                rides += 1;
            }
        });
        println!(
            "{turn_us} µs: {rides} rides, {} J a cycle: {}",
            worst.0, worst.1
        );
        assert!(
            worst.0 <= ROUNDING,
            "{turn_us} µs, {}: {} J",
            worst.1,
            worst.0
        );
    }
}

/// The samples stay away for 30 ms, and the force is zero; then it grows. Once, the hand may be given what the springs hold meanwhile.
#[test]
fn after_silence_a_hand_is_given_what_the_springs_hold_once() {
    let (places, hands) = hands();
    let device = Late {
        turn_us: 675,
        limits: Limits::default(),
    };
    let (mut random, mut worst) = (Random(2), Worst::new());
    from_everywhere(device, places, |scene, ride, at| {
        for _ in 0..hands {
            let mut ride = ride.clone();
            let (frequency, hand) = sine(&mut random, at, ride.time());
            for _ in 0..30 {
                ride.turn(&hand, false);
            }
            assert_eq!(ride.servo.force(), Wrench::default());
            ride.begin();
            let (from, mut most, mut grows) = (ride.time(), 0.0_f64, true);
            while ride.time() < from + 2.0 / frequency {
                ride.turn(&hand, true);
                // Until then the springs have been given their force, and what they hold is the hand's.
                most = if grows { most.max(ride.stored()) } else { most };
                grows &= ride.grows;
                let owned = if grows { ride.own() } else { 0.0 };
                worst.see(ride.beyond(most) - owned, || {
                    format!("{scene}, {frequency} Hz")
                });
            }
        }
    });
    println!("{} J: {}", worst.0, worst.1);
    assert!(worst.0 <= ROUNDING, "{}: {} J", worst.1, worst.0);
}
