//! Arguments from JavaScript, which may be of any type: each is read, or refused with its name, its value and what is allowed.
//!
//! A parameter of the type `&str`, `&[f64]` or `f64` would not be checked: the code of wasm-bindgen writes the argument into memory
//! as if it had that type.

use js_sys::{Array, Float32Array, Float64Array, Object, Reflect};
use stiction_scene::text::unknown;
use wasm_bindgen::prelude::*;

/// The error for an argument or option.
pub(crate) fn refused(name: &str, value: &JsValue, allowed: &str) -> JsError {
    JsError::new(&format!("`{name}` is {}, allowed: {allowed}", shown(value)))
}

/// A value in a message: that of an object is its type, as its content may be long.
fn shown(value: &JsValue) -> String {
    let debug = format!("{value:?}");
    let inner = debug.strip_prefix("JsValue(");
    let inner = inner.and_then(|rest| rest.strip_suffix(')'));
    match inner {
        Some(_) if Array::is_array(value) => "an array".to_owned(),
        Some(_) if value.is_object() => "an object".to_owned(),
        Some(simple) => simple.to_owned(),
        None => debug,
    }
}

pub(crate) fn text(name: &str, value: &JsValue) -> Result<String, JsError> {
    let text = value.as_string();
    text.ok_or_else(|| refused(name, value, "a string"))
}

/// A number; NaN and infinity are numbers.
pub(crate) fn number(name: &str, value: &JsValue) -> Result<f64, JsError> {
    let number = value.as_f64();
    number.ok_or_else(|| refused(name, value, "a number"))
}

/// Whether it is true; the numbers of a row of samples, 0 and 1, are allowed, too.
pub(crate) fn truth(name: &str, value: &JsValue) -> Result<bool, JsError> {
    let number = value.as_f64().filter(|number| [0.0, 1.0].contains(number));
    let truth = value.as_bool().or(number.map(|number| number == 1.0));
    truth.ok_or_else(|| refused(name, value, "true or false"))
}

/// An argument that may be left out.
pub(crate) fn or<T>(
    name: &str,
    value: &JsValue,
    default: T,
    read: impl FnOnce(&str, &JsValue) -> Result<T, JsError>,
) -> Result<T, JsError> {
    match value.is_null_or_undefined() {
        true => Ok(default),
        false => read(name, value),
    }
}

/// The numbers of a typed array, or of an array.
pub(crate) fn numbers(name: &str, value: &JsValue) -> Result<Vec<f64>, JsError> {
    if let Some(array) = value.dyn_ref::<Float64Array>() {
        return Ok(array.to_vec());
    }
    if let Some(array) = value.dyn_ref::<Float32Array>() {
        return Ok(array.to_vec().into_iter().map(f64::from).collect());
    }
    let Some(array) = value.dyn_ref::<Array>() else {
        return Err(refused(name, value, "a Float64Array"));
    };
    let item = |(k, value): (usize, JsValue)| number(&format!("{name}[{k}]"), &value);
    array.iter().enumerate().map(item).collect()
}

/// Refuses options that are no object, and a key that no option has.
pub(crate) fn keys(options: &JsValue, known: &[&str]) -> Result<(), JsError> {
    if options.is_undefined() {
        return Ok(());
    }
    let Some(object) = options
        .dyn_ref::<Object>()
        .filter(|_| !Array::is_array(options))
    else {
        let allowed = format!("an object with any of {}", known.join(", "));
        return Err(refused("options", options, &allowed));
    };
    for key in Object::keys(object)
        .iter()
        .filter_map(|key| key.as_string())
    {
        if !known.contains(&key.as_str()) {
            return Err(JsError::new(&unknown("option", &key, known)));
        }
    }
    Ok(())
}

/// An option, if given.
fn option(options: &JsValue, name: &str) -> Option<JsValue> {
    let value = Reflect::get(options, &name.into()).ok()?;
    (!value.is_undefined()).then_some(value)
}

/// An option that is one of some names.
pub(crate) fn chosen<T>(
    options: &JsValue,
    name: &str,
    default: T,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, JsError> {
    let Some(value) = option(options, name) else {
        return Ok(default);
    };
    let text = value.as_string().unwrap_or_default();
    let problem = |allowed| JsError::new(&format!("`{name}` is {}, {allowed}", shown(&value)));
    parse(&text).map_err(problem)
}

/// An option that is a whole number from 1.
pub(crate) fn count(options: &JsValue, name: &str, default: u32) -> Result<u32, JsError> {
    let Some(value) = option(options, name) else {
        return Ok(default);
    };
    let units = value.as_f64().unwrap_or_default();
    if units >= 1.0 && units <= f64::from(u32::MAX) && units.fract() == 0.0 {
        return Ok(units as u32);
    }
    let allowed = format!("a whole number from 1 to {}", u32::MAX);
    Err(refused(name, &value, &allowed))
}
