//! Scenes with the hand of `walk.c`, by the solver itself: a hash of all answers for each.

use std::fmt::Write;

use stiction_core::{Evolution, Hand, Real, Solver, State, Touch};
use stiction_scene::{HostSolver, SceneFile, Source, c_source};

use crate::library::{Library, Room, folder};

const SCENES_BY_WALLS: [&str; 10] = [
    "box-flat",
    "burst",
    "corner-stick-slip",
    "edge-about-to-slip",
    "ladder",
    "locked",
    "parallel-walls",
    "point-stick-slip",
    "rod-on-floor",
    "vertex-stick-slip",
];
const SCENES_ON_A_PLANE: [&str; 6] = [
    "box-flat",
    "burst",
    "edge-about-to-slip",
    "point-stick-slip",
    "rod-on-floor",
    "vertex-stick-slip",
];
const SCENES_AMONG_OBSTACLES: [&str; 4] = ["table-edge", "step", "plank-on-posts", "peg-in-hole"];

impl Library {
    fn scenes(self) -> &'static [&'static str] {
        match self.room {
            Room::Surfaces => &SCENES_BY_WALLS,
            Room::Obstacles => &SCENES_AMONG_OBSTACLES,
            Room::Plane => &SCENES_ON_A_PLANE,
        }
    }
}

fn scene(name: &str) -> SceneFile {
    let file = folder().join(format!("../../host-sim/scenes/{name}.toml"));
    let source = Source::read(&file).expect("a bundled scene");
    SceneFile::parse(source, f32::MAX.into()).expect("a sound scene")
}

pub(crate) fn scenes_header(library: &Library) -> String {
    let mut code = String::new();
    let names = library.scenes();
    for (i, name) in names.iter().enumerate() {
        code += &c_source(&scene(name), library.number, &format!("scene_{i}"));
    }
    let all: Vec<String> = (0..names.len()).map(|i| format!("&scene_{i}")).collect();
    let (count, all) = (names.len(), all.join(", "));
    // Writing to a string cannot fail.
    let _ = write!(
        code,
        "#define SCENES {count}\nstatic const stiction_scene *const scenes[SCENES] = {{{all}}};\n"
    );
    code
}

/// Feature and other of a contact as the library numbers them.
fn features(touch: Touch) -> [usize; 2] {
    match touch {
        Touch::Surface { vertex, surface } => [vertex, surface],
        Touch::Side {
            vertex, obstacle, ..
        } => [vertex, obstacle],
        Touch::Corner {
            obstacle,
            body_side,
            ..
        } => [body_side, obstacle],
    }
}

/// Marsaglia's xorshift of 32 bits.
struct Random(u32);

impl Random {
    fn bits(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    fn walk(&mut self, place: &mut i32, most: i32, limit: i32) {
        let to = *place + (self.bits() % (2 * most as u32 + 1)) as i32 - most;
        if (-limit..=limit).contains(&to) {
            *place = to;
        }
    }
}

/// FNV-1a, a word at a time.
struct Hash(u32);

impl Hash {
    fn take(&mut self, word: u32) {
        self.0 = (self.0 ^ word).wrapping_mul(16_777_619);
    }

    fn take_floats(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.take(number.to_bits());
        }
    }
}

pub(crate) fn hashes<R: Real<Si = f32>>(library: &Library, frames: u32) -> Vec<u32> {
    let names = library.scenes().iter().enumerate();
    names
        .map(|(i, name)| {
            let file = scene(name);
            let (scene, _) = file.written.scene_in().expect("a sound scene");
            let solver = Solver::new(scene, Evolution::ALL[i % 2]);
            let (start, _) = file
                .written
                .described::<R, _>(|description| description.start);
            hash::<R>(&solver, start, 2_463_534_242 + i as u32, frames)
        })
        .collect()
}

fn hash<R: Real<Si = f32>>(solver: &HostSolver<R>, start: [f32; 3], seed: u32, frames: u32) -> u32 {
    let (mut random, mut hash) = (Random(seed), Hash(2_166_136_261));
    let [mut x, mut y, mut phi] = [0; 3];
    let mut run: Option<State<R>> = None;
    for _ in 0..frames {
        let unit = 1.0 / (1 << 20) as f32;
        let hand = Hand::new(
            start[0] + unit * x as f32,
            start[1] + unit * y as f32,
            start[2] + unit * phi as f32,
        );
        let output = match &mut run {
            Some(run) => solver.step(run, hand),
            None => {
                let (begun, output) = solver.start(hand);
                run = Some(begun);
                output
            }
        };
        let Some(state) = &run else { continue };
        hash.take_floats(&output.position);
        hash.take_floats(&[output.angle.rest]);
        hash.take(output.angle.turns as u32);
        hash.take(output.slips);
        let events = output.events().len() as u32;
        hash.take(output.state as u32 | (output.status as u32) << 8 | events << 16);
        let wrench = solver.wrench(state);
        hash.take_floats(&wrench.force);
        hash.take_floats(&[wrench.moment]);
        for contact in solver.contacts(state).iter() {
            let [feature, other] = features(contact.touch);
            hash.take_floats(&[contact.point[0], contact.normal, contact.friction]);
            let sliding = u32::from(contact.sliding as u8);
            hash.take(feature as u32 | (other as u32) << 8 | sliding << 16);
        }
        random.walk(&mut x, 1 << 11, 1 << 17);
        random.walk(&mut y, 1 << 11, 1 << 16);
        random.walk(&mut phi, 1 << 14, 1 << 20);
    }
    hash.0
}
