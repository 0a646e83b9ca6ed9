//! The solver by law and by state. It is one program, so that every number type, evolution and model of the solver is
//! compiled only once; `cargo test -p stiction-tests --test solver NAME` runs the tests of a module.

mod allocation;
mod ambiguous;
mod analytic;
mod begins;
mod buckles;
mod budget;
mod carry;
mod comparison;
mod creep;
mod documents;
mod dragged_box;
mod extremes;
mod follows_reference;
mod glide;
mod hand;
mod haptic;
mod jams;
mod laws;
mod models;
mod one_coefficient;
mod projection;
mod range;
mod reactions;
mod scene_errors;
mod size;
mod slips;
mod slots;
mod snapshot;
mod swings;
mod symmetry;
mod tangent;
mod work;
