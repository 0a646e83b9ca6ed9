//! The bundled scenes, and the hand's path of a scene.

use std::path::Path;

use js_sys::Float64Array;
use stiction_live::input::open_path;
use stiction_live::number::Number;
use stiction_live::scenes;
use stiction_scene::{SceneFile, Source};
use wasm_bindgen::prelude::*;

use crate::arguments;

/// A scene, given by the name of a bundled one or by its text.
pub(crate) fn read(scene: &str, number: Number) -> Result<SceneFile, JsError> {
    let source = match scenes::find(Path::new(scene)) {
        Some(source) => source,
        // A name has no line breaks; a scene has some.
        None if !scene.contains('\n') => {
            let problem = format!(
                "no scene {scene:?}, allowed: the text of a scene file, or one of {}",
                scenes::names()
            );
            return Err(JsError::new(&problem));
        }
        None => Source::new("scene.toml", scene),
    };
    SceneFile::parse(source, number.limit()).map_err(|error| JsError::new(&error.to_string()))
}

/// The names of the bundled scenes.
#[wasm_bindgen(js_name = sceneNames)]
pub fn scene_names() -> Vec<String> {
    let all = scenes::ALL.iter();
    all.map(|(name, _)| (*name).to_owned()).collect()
}

/// The text of a bundled scene, as in a scene file (TOML, SI units).
///
/// Throws if there is no scene with that name.
#[wasm_bindgen(js_name = sceneText)]
pub fn scene_text(
    #[wasm_bindgen(unchecked_param_type = "string")] name: JsValue,
) -> Result<String, JsError> {
    let name = arguments::text("name", &name)?;
    let source = scenes::find(Path::new(&name));
    let source = source.ok_or_else(|| {
        let problem = format!("no scene {name:?}, allowed: {}", scenes::names());
        JsError::new(&problem)
    })?;
    Ok(source.text().to_owned())
}

/// The path of a scene's hand, as rows for `Solver.run`: t (s), x, y (m), phi (rad, unwrapped), held (0 or 1).
///
/// `scene`: the name of a bundled scene, or the text of a scene file. `rate`: rows per second (Hz); by default that of the scene.
///
/// Throws if the scene is refused, or has no path.
#[wasm_bindgen(js_name = scenePath)]
pub fn scene_path(
    #[wasm_bindgen(unchecked_param_type = "string")] scene: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "number")] rate: JsValue,
) -> Result<Float64Array, JsError> {
    let scene = arguments::text("scene", &scene)?;
    let rate = arguments::or("rate", &rate, None, |name, value| {
        let rate = value
            .as_f64()
            .filter(|rate| rate.is_finite() && *rate > 0.0);
        let allowed = "a finite number above 0";
        rate.map(Some)
            .ok_or_else(|| arguments::refused(name, value, allowed))
    })?;
    let scene = read(&scene, Number::F64)?;
    let path = open_path(&scene, None, rate.map(|rate| ("rate", rate)));
    let (path, rate) = path.map_err(|error| JsError::new(&error.to_string()))?;
    let rows = path.frames(rate).flat_map(|sample| {
        let ([x, y], phi) = (sample.hand.position, sample.hand.angle.radians());
        [sample.t, x, y, phi, f64::from(u8::from(sample.hand.held))]
    });
    Ok(Float64Array::from(rows.collect::<Vec<f64>>().as_slice()))
}
