//! A job of the instruction bench returns the solver's own answers; bytes that are not a job are refused.

use stiction_core::{
    Angle, Description, Evolution, Fixed, Hand, Parameter, Real, Scene, SiFloat, Solver,
    SurfaceDescription, Weightless, narrow_hand,
};
use stiction_firmware::count::{Failure, FileError, Files, Instruments, run, run_in_model};
use stiction_firmware::job::{self, FormatError, Frame, Results};

const SAMPLES: u32 = 100;
const SURFACE: SurfaceDescription<f64> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: Some(1e-3),
};
const WALL: SurfaceDescription<f64> = SurfaceDescription {
    normal: [-1.0, 0.0],
    offset: -0.5,
    memory: None,
    ..SURFACE
};
const SCENE: Description<'static, f64> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.01, 0.0727, 0.5],
    weight: 0.25,
    holding_point: Some([0.0, 0.02]),
    reach: 0.01,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[SURFACE, WALL],
};

/// Files in memory.
struct Memory {
    job: Vec<u8>,
    taken: usize,
    results: Vec<u8>,
}

impl Memory {
    fn new(job: Vec<u8>) -> Self {
        Self {
            job,
            taken: 0,
            results: Vec::new(),
        }
    }
}

/// Counts calls instead of instructions.
struct Calls(u32);

impl Files for Memory {
    fn read(&mut self, bytes: &mut [u8]) -> Result<(), FileError> {
        let end = self.taken + bytes.len();
        bytes.copy_from_slice(self.job.get(self.taken..end).ok_or(FileError)?);
        self.taken = end;
        Ok(())
    }
    fn write(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.results.extend_from_slice(bytes);
        Ok(())
    }
}

impl Instruments for Calls {
    fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        self.0 += 1;
        (self.0, work())
    }
    fn watch_stack(&mut self) {}
    fn deepest_stack(&mut self) -> u32 {
        4321
    }
}

/// Down onto the floor and along it, with some whole turns.
fn hand(i: u32) -> Hand<f64> {
    let t = f64::from(i) / f64::from(SAMPLES);
    Hand {
        position: [0.05 * t, 0.09 - 0.05 * t],
        angle: Angle {
            turns: -3,
            rest: 0.5 - t,
        },
        depth: 0.0,
        held: i != 60,
        tilted: false,
    }
}

fn job_of(scene: &Description<'_, f64>, evolution: Evolution) -> Vec<u8> {
    let mut bytes = Vec::new();
    let done: Result<(), ()> =
        job::write_scene((scene, &[]), evolution, (SAMPLES, u32::MAX), |part| {
            bytes.extend_from_slice(part);
            Ok(())
        });
    assert_eq!(done, Ok(()));
    bytes.extend((0..SAMPLES).flat_map(|i| job::encode_sample(&hand(i))));
    bytes
}

fn done(job: Vec<u8>) -> Result<Vec<u8>, Failure> {
    let mut files = Memory::new(job);
    run::<f32, 8, 4>(&mut files, &mut Calls(0))?;
    Ok(files.results)
}

fn comes_back<R: Real<Si: SiFloat>>(evolution: Evolution) {
    let mut files = Memory::new(job_of(&SCENE, evolution));
    run::<R, 8, 4>(&mut files, &mut Calls(0)).unwrap();
    let results = Results::read(&files.results).unwrap();
    assert_eq!(
        (results.totals.frames, results.totals.stack),
        (SAMPLES, 4321)
    );

    let narrow = R::Si::narrow;
    let scene = Scene::<R, 8, 4>::new(&Description {
        vertices: &SCENE
            .vertices
            .iter()
            .map(|v| v.map(narrow))
            .collect::<Vec<_>>(),
        start: SCENE.start.map(narrow),
        weight: narrow(SCENE.weight),
        holding_point: SCENE.holding_point.map(|point| point.map(narrow)),
        reach: narrow(SCENE.reach),
        stiffness_translation: narrow(SCENE.stiffness_translation),
        stiffness_rotation: narrow(SCENE.stiffness_rotation),
        surfaces: &[SURFACE, WALL].map(|surface| SurfaceDescription {
            normal: surface.normal.map(narrow),
            offset: narrow(surface.offset),
            friction_static: narrow(surface.friction_static),
            friction_dynamic: narrow(surface.friction_dynamic),
            memory: surface.memory.map(narrow),
        }),
    });
    let solver = Solver::new(scene.unwrap(), evolution);
    let (mut state, first) = solver.start(narrow_hand(&hand(0)));
    for (i, frame) in (0..).zip(results.frames()) {
        let output = match i {
            0 => first.clone(),
            _ => solver.step(&mut state, narrow_hand(&hand(i))),
        };
        assert_eq!(frame, Ok(Frame::new(i + 1, &output)), "frame {i}");
    }
}

#[test]
fn a_job_comes_back_with_the_answers_of_the_solver() {
    for evolution in [Evolution::Path, Evolution::Frame] {
        comes_back::<f32>(evolution);
        comes_back::<Fixed>(evolution);
        comes_back::<f64>(evolution);
    }
}

#[test]
fn in_a_model_of_its_own_it_gives_the_same_answers() {
    let weightless = Description {
        weight: 0.0,
        ..SCENE
    };
    let mut own = Memory::new(job_of(&weightless, Evolution::Frame));
    run::<f64, 8, 4>(&mut own, &mut Calls(0)).unwrap();
    let in_model = |scene| {
        let mut files = Memory::new(job_of(scene, Evolution::Path));
        run_in_model::<f64, 4, 2, Weightless>(Evolution::Frame, &mut files, &mut Calls(0))?;
        Ok(files)
    };
    let small = in_model(&weightless).unwrap();
    let [own, small] = [&own, &small].map(|files| Results::read(&files.results).unwrap());
    assert!(own.frames().eq(small.frames()));
    assert!(small.totals.solver < own.totals.solver);
    assert!(matches!(in_model(&SCENE), Err(Failure::Scene(_))));
}

#[test]
fn what_is_not_a_job_is_refused() {
    let good = job_of(&SCENE, Evolution::Path);
    for (at, wrong, expected) in [
        (0, b'x', Failure::Format(FormatError::Mark)),
        (4, job::VERSION + 1, Failure::Format(FormatError::Mark)),
        (5, 2, Failure::Format(FormatError::Value)),
        (6, 9, Failure::Format(FormatError::Value)),
        (7, 5, Failure::Format(FormatError::Value)),
    ] {
        let mut job = good.clone();
        job[at] = wrong;
        assert_eq!(done(job), Err(expected), "byte {at}");
    }
    let short = good[..good.len() - 1].to_vec();
    assert_eq!(done(short), Err(Failure::File));
    let sunk = Description {
        start: [0.0; 3],
        ..SCENE
    };
    assert!(matches!(
        done(job_of(&sunk, Evolution::Path)),
        Err(Failure::Scene(Parameter::Penetration { surface: 0, .. }))
    ));
}

#[test]
fn what_is_not_whole_is_no_result() {
    let good = done(job_of(&SCENE, Evolution::Path)).unwrap();
    assert!(Results::read(&good).is_ok());
    for cut in [1, 24, 40, good.len() - 9] {
        assert!(Results::read(&good[..good.len() - cut]).is_err(), "{cut}");
    }
    let mut other = good;
    other[0] = b'x';
    assert_eq!(Results::read(&other).err(), Some(FormatError::Mark));
}
