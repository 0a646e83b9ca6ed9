//! A scene as C, for the C library: constants of the types of `stiction.h`.

use std::fmt::Write;

use stiction_core::{Description, Fixed, ObstacleDescription, SurfaceDescription};
use stiction_wire::NumberType;

use crate::written::WrittenScene;

/// The C code of a scene for the library of a number type: `static const stiction_scene NAME`, and the arrays that its pointers refer
/// to. `name` is a C identifier.
pub fn c_source(scene: &WrittenScene, number: NumberType, name: &str) -> String {
    let code = |d: &Description<'_, f32>| whole(name, d);
    match number {
        NumberType::F32 => scene.described::<f32, _>(code).0,
        NumberType::Fixed => scene.described::<Fixed, _>(code).0,
    }
}

fn whole(name: &str, d: &Description<'_, f32>) -> String {
    let mut code = points(&format!("{name}_vertices"), d.vertices);
    let surfaces = list(&mut code, "surface", name, d.surfaces.iter().map(surface));
    for (i, obstacle) in d.obstacles.iter().enumerate() {
        code += &points(&format!("{name}_obstacle_{i}"), obstacle.vertices);
    }
    let numbered = d.obstacles.iter().enumerate();
    let obstacles = list(
        &mut code,
        "obstacle",
        name,
        numbered.map(|(i, o)| obstacle(name, i, o)),
    );
    let holding_point = d.holding_point.map_or_else(String::new, |point| {
        format!(
            "\n    .holding_point = {},\n    .has_holding_point = 1,",
            row(&point)
        )
    });
    // Writing to a string cannot fail.
    let _ = write!(
        code,
        "static const stiction_scene {name} = {{
    .vertices = {name}_vertices,
    .vertex_count = {},
    .start = {},
    .weight = {},{holding_point}
    .reach = {},
    .stiffness_translation = {},
    .stiffness_rotation = {},{surfaces}{obstacles}
}};
",
        d.vertices.len(),
        row(&d.start),
        float(d.weight),
        float(d.reach),
        float(d.stiffness_translation),
        float(d.stiffness_rotation),
    );
    code
}

/// Adds a list of one kind to the code, unless it is empty; returns the members of the scene that refer to it.
fn list(code: &mut String, kind: &str, name: &str, items: impl Iterator<Item = String>) -> String {
    let items: Vec<String> = items.collect();
    if items.is_empty() {
        return String::new();
    }
    let count = items.len();
    *code += &format!(
        "static const stiction_{kind} {name}_{kind}s[{count}] = {{\n{}}};\n",
        items.concat()
    );
    format!("\n    .{kind}s = {name}_{kind}s,\n    .{kind}_count = {count},")
}

fn points(name: &str, points: &[[f32; 2]]) -> String {
    let rows: Vec<String> = points.iter().map(|point| row(point)).collect();
    format!(
        "static const float {name}[{}][2] = {{{}}};\n",
        points.len(),
        rows.join(", ")
    )
}

fn surface(d: &SurfaceDescription<f32>) -> String {
    format!(
        "    {{.normal = {}, .offset = {}, {}}},\n",
        row(&d.normal),
        float(d.offset),
        friction(d.friction_static, d.friction_dynamic, d.memory)
    )
}

fn obstacle(name: &str, index: usize, d: &ObstacleDescription<'_, f32>) -> String {
    format!(
        "    {{.vertices = {name}_obstacle_{index}, .vertex_count = {}, {}}},\n",
        d.vertices.len(),
        friction(d.friction_static, d.friction_dynamic, d.memory)
    )
}

fn friction(of_static: f32, of_dynamic: f32, memory: Option<f32>) -> String {
    let memory = memory.map_or_else(String::new, |memory| {
        format!(", .memory = {}, .has_memory = 1", float(memory))
    });
    format!(
        ".friction_static = {}, .friction_dynamic = {}{memory}",
        float(of_static),
        float(of_dynamic)
    )
}

fn row(numbers: &[f32]) -> String {
    let numbers: Vec<String> = numbers.iter().copied().map(float).collect();
    format!("{{{}}}", numbers.join(", "))
}

/// The decimal representation that reads back to the same bits.
fn float(number: f32) -> String {
    format!("{number:?}f")
}
