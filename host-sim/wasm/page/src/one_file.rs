//! The page in one file: a browser that opens a local file loads no separate module, worker or wasm. The modules are in an import
//! map, as `data:` URLs; the worker and the wasm are packed into a script element that the browser does not run.

use std::collections::BTreeMap;
use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Map, Value, json};

use crate::Built;
use crate::folder::{File, Page};

/// The prefix of a module's name in the import map.
const BARE: &str = "stiction/";

/// The page.
pub(crate) fn page(all: &Page) -> Built<String> {
    let files = all.web.as_slice();
    let mut page = text(files, "index.html")?;
    put(
        &mut page,
        r#"<link rel="icon" href="icon.svg" type="image/svg+xml">"#,
        &format!(
            r#"<link rel="icon" href="data:image/svg+xml;base64,{}">"#,
            STANDARD.encode(find(files, "icon.svg")?)
        ),
    )?;
    for name in [
        "uplot/uplot.min.css",
        "style.css",
        "panels.css",
        "first.css",
    ] {
        let link = format!(r#"<link rel="stylesheet" href="{name}">"#);
        put(&mut page, &link, &element("style", &text(files, name)?)?)?;
    }
    let mut modules = modules(files)?;
    let packed = json!({
        "worker": packed(&all.worker),
        "wasm": packed(&all.wasm),
    });
    for (module, name) in [
        ("insertion.js", "insertion.css"),
        ("files.js", "editor.css"),
    ] {
        let style = STANDARD.encode(find(files, name)?);
        if let Some(code) = modules.get_mut(module) {
            let data = format!("\"data:text/css;base64,{style}\"");
            put(code, &format!("\"{name}\""), &data)?;
        }
    }
    let pictures: Map<String, Value> = all
        .pictures
        .iter()
        .map(|(name, svg)| (name.clone(), svg.as_str().into()))
        .collect();
    let scripts = scripts(files, modules, [&packed, &Value::Object(pictures)])?;
    put(
        &mut page,
        r#"<script type="module" src="main.js"></script>"#,
        &scripts,
    )?;
    Ok(page)
}

/// The scripts in the place of the page's own one: the modules, then the data packed and the pictures, then the main module.
fn scripts(
    files: &[File],
    mut modules: BTreeMap<String, String>,
    [packed, pictures]: [&Value; 2],
) -> Built<String> {
    let main = modules.remove("main.js").unwrap_or_default();
    let imports: Map<String, Value> = modules
        .into_iter()
        .map(|(name, code)| {
            let url = format!("data:text/javascript;base64,{}", STANDARD.encode(code));
            (format!("{BARE}{name}"), url.into())
        })
        .collect();
    let map = json!({ "imports": imports });
    // A text in which no tag is seen.
    let pictures = pictures.to_string().replace('<', "\\u003c");
    let uplot = element("script", &text(files, "uplot/uplot.min.js")?)?;
    Ok(format!(
        "{uplot}\n<script type=\"importmap\">{map}</script>\n\
         <script type=\"application/json\" id=\"packed\">{packed}</script>\n\
         <script type=\"application/json\" id=\"pictures\">{pictures}</script>\n\
         <script type=\"module\">{}</script>",
        closed(&main)?
    ))
}

/// The modules by name; they import each other by bare names.
fn modules(files: &[File]) -> Built<BTreeMap<String, String>> {
    let scripts = files
        .iter()
        .filter(|(name, _)| name.ends_with(".js") && !name.starts_with("uplot/"));
    scripts
        .map(|(name, _)| {
            let code = text(files, name)?;
            Ok((name.clone(), code.replace("\"./", &format!("\"{BARE}"))))
        })
        .collect()
}

fn find<'a>(files: &'a [File], name: &str) -> Built<&'a [u8]> {
    let found = files.iter().find(|(known, _)| known == name);
    let found = found.ok_or_else(|| format!("there is no {name}"))?;
    Ok(&found.1)
}

fn text(files: &[File], name: &str) -> Built<String> {
    Ok(String::from_utf8_lossy(find(files, name)?).into_owned())
}

/// Replaces a part of the page.
fn put(page: &mut String, part: &str, other: &str) -> Built<()> {
    if !page.contains(part) {
        return Err(format!("index.html has no {part}").into());
    }
    *page = page.replacen(part, other, 1);
    Ok(())
}

fn element(name: &str, content: &str) -> Built<String> {
    Ok(format!("<{name}>{}</{name}>", closed(content)?))
}

/// Content of an element, checked not to end it.
fn closed(content: &str) -> Built<&str> {
    match content.contains("</s") {
        true => Err("a script or style has </s in it".into()),
        false => Ok(content),
    }
}

fn packed(bytes: &[u8]) -> String {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    // Writing to memory cannot fail.
    let _ = packer.write_all(bytes);
    STANDARD.encode(packer.finish().unwrap_or_default())
}
