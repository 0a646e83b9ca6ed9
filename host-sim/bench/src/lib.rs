//! This package contains only benches: `step`, the time of a frame; `rivals`, the same scenes in a physics engine.
