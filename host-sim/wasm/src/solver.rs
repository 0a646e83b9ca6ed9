//! A solver that runs sample by sample: from rows of the hand's motion to records of the trace, or to typed arrays.

use js_sys::{Array, Float64Array, JSON, Object, Uint8Array, Uint32Array};
use stiction_core::{StateKind, Status};
use stiction_live::guide::HandPose;
use stiction_live::number::{Number, parse_evolution, parse_number};
use stiction_live::record::{Frame, Run};
use stiction_live::session::Session;
use stiction_scene::Sample;
use wasm_bindgen::prelude::*;

use crate::{arguments, scenes};

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
    pub fn new(
        #[wasm_bindgen(unchecked_param_type = "string")] scene: JsValue,
        options: Option<SolverOptions>,
    ) -> Result<Self, JsError> {
        let scene = arguments::text("scene", &scene)?;
        let options = options.map_or(JsValue::UNDEFINED, JsValue::from);
        arguments::keys(&options, &["number", "evolution", "budget"])?;
        let number = arguments::chosen(&options, "number", Number::F32, parse_number)?;
        let evolution = Default::default();
        let evolution = arguments::chosen(&options, "evolution", evolution, parse_evolution)?;
        let budget = arguments::count(&options, "budget", u32::MAX)?;
        let scene = scenes::read(&scene, number)?;
        let session = Session::new(&scene, number, evolution, budget);
        Ok(Self {
            session: session.map_err(|error| JsError::new(&error.to_string()))?,
            run: Run::of(&scene, number, evolution),
        })
    }

    /// Moves the hand to `x`, `y` (m) and `phi` (rad, unwrapped) in the world, and returns the equilibrium there.
    ///
    /// `held`: whether the hand holds the body, by default true. `t`: the time of the sample (s), which the answer repeats; by default 0.
    ///
    /// Throws if an argument is of another type. Where a number is NaN or infinite, the hand stays where it was.
    pub fn step(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] phi: JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "boolean")] held: JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "number")] t: JsValue,
    ) -> Result<FrameObject, JsError> {
        let number = arguments::number;
        let pose = [number("x", &x)?, number("y", &y)?, number("phi", &phi)?];
        let t = arguments::or("t", &t, 0.0, number)?;
        let held = arguments::or("held", &held, true, arguments::truth)?;
        let sample = sample(t, pose, held);
        let frame = self.session.step(&sample);
        let text = serde_json::to_string(&self.run.record(&frame))?;
        let object = JSON::parse(&text).map_err(|_| JsError::new("no JSON"))?;
        Ok(object.unchecked_into())
    }

    /// Moves the hand along `samples`, from where the solver is, and returns all answers: those of a `step` for each sample.
    ///
    /// `samples`: rows of five numbers, t (s), x, y (m), phi (rad, unwrapped), held (0 or 1), in the world.
    ///
    /// Throws if `samples` is something else, or does not consist of whole rows.
    pub fn run(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Float64Array")] samples: JsValue,
    ) -> Result<Answers, JsError> {
        let samples = arguments::numbers("samples", &samples)?;
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
