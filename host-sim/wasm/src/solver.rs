//! A solver that runs sample by sample: from rows of the hand's motion to records of the trace, or to typed arrays.

use js_sys::{Array, Float64Array, JSON, Object, Reflect, Uint8Array, Uint32Array};
use stiction_core::{StateKind, Status};
use stiction_live::guide::HandPose;
use stiction_live::number::{Number, parse_evolution, parse_number};
use stiction_live::record::{Frame, Run};
use stiction_live::session::Session;
use stiction_scene::Sample;
use wasm_bindgen::prelude::*;

use crate::scenes;

/// Numbers per row of the hand's motion.
const ROW: usize = 5;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = include_str!("types.d.ts");

#[wasm_bindgen]
extern "C" {
    /// Options in addition to the scene.
    #[wasm_bindgen(typescript_type = "SolverOptions")]
    pub type SolverOptions;
    /// A record of the trace.
    #[wasm_bindgen(typescript_type = "Frame")]
    pub type FrameObject;
    /// The answers to many samples.
    #[wasm_bindgen(typescript_type = "Answers")]
    pub type Answers;
}

/// A solver with its scene and its run. The first sample starts the scene; every further one moves the hand.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Solver {
    session: Session,
    run: Run,
}

#[wasm_bindgen]
impl Solver {
    /// Creates a solver for a scene, before its first sample.
    ///
    /// `scene`: the name of a bundled scene, or the text of a scene file (TOML, SI units).
    ///
    /// Throws if the scene or an option is refused: the message names the key and the line, and what is allowed.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, options: Option<SolverOptions>) -> Result<Self, JsError> {
        let options = options.map_or(JsValue::UNDEFINED, JsValue::from);
        let number = chosen(&options, "number", Number::F32, parse_number)?;
        let evolution = chosen(&options, "evolution", Default::default(), parse_evolution)?;
        let budget = match field(&options, "budget") {
            None => u32::MAX,
            Some(value) => budget(&value)?,
        };
        let scene = scenes::read(scene, number)?;
        let session = Session::new(&scene, number, evolution, budget);
        Ok(Self {
            session: session.map_err(|error| JsError::new(&error.to_string()))?,
            run: Run::of(&scene, number, evolution),
        })
    }

    /// Moves the hand to `x`, `y` (m) and `phi` (rad, unwrapped) in the world, and returns the equilibrium there.
    ///
    /// `held`: whether the hand holds the body, by default true. `t`: the time of the sample (s), which the answer repeats; by default 0.
    pub fn step(
        &mut self,
        x: f64,
        y: f64,
        phi: f64,
        held: Option<bool>,
        t: Option<f64>,
    ) -> Result<FrameObject, JsError> {
        let sample = sample(t.unwrap_or(0.0), [x, y, phi], held.unwrap_or(true));
        let frame = self.session.step(&sample);
        let text = serde_json::to_string(&self.run.record(&frame))?;
        let object = JSON::parse(&text).map_err(|_| JsError::new("no JSON"))?;
        Ok(object.unchecked_into())
    }

    /// Moves the hand along `samples`, from where the solver is, and returns all answers: those of a `step` for each sample.
    ///
    /// `samples`: rows of five numbers, t (s), x, y (m), phi (rad, unwrapped), held (0 or 1), in the world.
    ///
    /// Throws if `samples` does not consist of whole rows.
    pub fn run(&mut self, samples: &[f64]) -> Result<Answers, JsError> {
        let (rows, rest) = samples.as_chunks::<ROW>();
        if !rest.is_empty() {
            let problem = format!(
                "`samples` has {} numbers, allowed: rows of {ROW}: t, x, y, phi, held",
                samples.len()
            );
            return Err(JsError::new(&problem));
        }
        let mut table = Table::default();
        for &[t, x, y, phi, held] in rows {
            table.add(&self.session.step(&sample(t, [x, y, phi], held != 0.0)));
        }
        table.object()
    }

    /// A copy, whose run continues independently from here.
    pub fn copy(&self) -> Self {
        self.clone()
    }

    /// The number type: `"f32"`, `"f64"` or `"fixed"`.
    #[wasm_bindgen(getter)]
    pub fn number(&self) -> String {
        self.run.number.name().to_owned()
    }
}

/// The names of the contact states, in the order of the numbers in `Answers.state`.
#[wasm_bindgen(js_name = stateNames)]
pub fn state_names() -> Vec<String> {
    StateKind::ALL.map(|state| state.name().to_owned()).to_vec()
}

/// The names of the statuses, which state what limited an answer, in the order of the numbers in `Answers.status`.
#[wasm_bindgen(js_name = statusNames)]
pub fn status_names() -> Vec<String> {
    Status::ALL.map(|status| status.name().to_owned()).to_vec()
}

fn sample(t: f64, pose: [f64; 3], held: bool) -> Sample {
    let hand = HandPose {
        pose,
        depth: 0.0,
        held,
    };
    Sample {
        t,
        hand: hand.hand(),
    }
}

/// A field of the options, if given.
fn field(options: &JsValue, name: &str) -> Option<JsValue> {
    let value = Reflect::get(options, &name.into()).ok()?;
    (!value.is_undefined()).then_some(value)
}

fn chosen<T>(
    options: &JsValue,
    name: &str,
    default: T,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, JsError> {
    let Some(value) = field(options, name) else {
        return Ok(default);
    };
    let text = value.as_string().unwrap_or_default();
    parse(&text).map_err(|allowed| JsError::new(&format!("`{name}` is {value:?}, {allowed}")))
}

fn budget(value: &JsValue) -> Result<u32, JsError> {
    let units = value.as_f64().unwrap_or_default();
    if units >= 1.0 && units <= f64::from(u32::MAX) && units.fract() == 0.0 {
        return Ok(units as u32);
    }
    let problem = format!(
        "`budget` is {value:?}, allowed: a whole number from 1 to {}",
        u32::MAX
    );
    Err(JsError::new(&problem))
}

#[derive(Debug, Default)]
struct Table {
    t: Vec<f64>,
    pose: Vec<f64>,
    wrench: Vec<f64>,
    state: Vec<u8>,
    status: Vec<u8>,
    slips: Vec<u32>,
    contacts: Vec<f64>,
}

impl Table {
    fn add(&mut self, frame: &Frame) {
        let place = |found: Option<usize>| found.unwrap_or_default() as u8;
        let k = self.t.len() as f64;
        self.t.push(frame.t);
        self.pose.extend(frame.pose);
        self.wrench.extend(frame.wrench);
        let state = StateKind::ALL
            .iter()
            .position(|known| *known == frame.state);
        let status = Status::ALL.iter().position(|known| *known == frame.status);
        self.state.push(place(state));
        self.status.push(place(status));
        self.slips.push(frame.slips);
        for contact in &frame.contacts {
            let [x, y] = contact.point;
            let sliding = f64::from(contact.sliding);
            self.contacts
                .extend([k, x, y, contact.normal, contact.friction, sliding]);
        }
    }

    fn object(&self) -> Result<Answers, JsError> {
        let floats = |values: &[f64]| JsValue::from(Float64Array::from(values));
        let bytes = |values: &[u8]| JsValue::from(Uint8Array::from(values));
        let columns = [
            ("t", floats(&self.t)),
            ("pose", floats(&self.pose)),
            ("wrench", floats(&self.wrench)),
            ("state", bytes(&self.state)),
            ("status", bytes(&self.status)),
            ("slips", Uint32Array::from(self.slips.as_slice()).into()),
            ("contacts", floats(&self.contacts)),
        ];
        let pairs: Array = columns
            .into_iter()
            .map(|(name, column)| Array::of2(&name.into(), &column))
            .collect();
        let object = Object::from_entries(&pairs)
            .map_err(|_| JsError::new("the answer cannot be made an object"))?;
        Ok(object.unchecked_into())
    }
}
