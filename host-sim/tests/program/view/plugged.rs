//! Boards that come and go: pulled out, away, never there; an emulated one lives as long as the view.

use std::sync::atomic::Ordering;

use serde_json::json;

use super::boards::{lead, with_board, with_hand};
use crate::common::{Folder, numbers};

#[test]
fn a_board_that_was_pulled_out_comes_back_at_the_start() {
    let (board, view) = with_board("box-flat");
    let mut client = view.client();
    client.done(json!({"type": "set", "parameters": {"stiffness_translation": 1000.0}}));
    lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
    client.done(json!({"type": "record", "value": true}));
    board.is_pulled.store(true, Ordering::Relaxed);
    client.frame(|frame| frame["board"]["connected"] == false);
    client.frame(|frame| frame["board"]["connected"] == true);
    with_hand(&mut client, [0.0, 0.07, 0.0]);
    client.state(|state| !state["recorded"].is_null());
    let pressed = lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
    // The parameters are those of before: 1000 N/m times 10 mm.
    let force = numbers(&pressed["frame"]["wrench"])[1];
    assert!((force + 10.0).abs() < 1e-3, "{force}");
}

#[test]
fn a_board_that_is_away_changes_nothing_and_ctrl_c_ends_the_view() {
    let (board, mut view) = with_board("box-flat");
    let mut client = view.client();
    drop(board);
    client.frame(|frame| frame["board"]["connected"] == false);
    let error = client.ask(json!({"type": "set", "parameters": {"static": 0.6}}));
    assert!(error.is_err_and(|error| error.contains("not connected")));
    view.interrupt();
    assert!(view.child.wait().expect("it ends").success());
}

#[test]
fn without_a_board_there_is_nothing_to_view() {
    let folder = Folder::new();
    folder.refused("view --socket nowhere --timeout 1", &["nowhere"]);
    folder.refused(
        "view --socket nowhere --number f64",
        &["cannot be used with"],
    );
}

#[cfg(target_os = "linux")]
mod emulated {
    use std::fs;
    use std::path::PathBuf;

    use serde_json::json;
    use stiction_host_sim::firmware::board::Board as Emulated;
    use stiction_host_sim::firmware::process::{if_installed, require_qemu_arm};

    use super::super::boards::lead;
    use super::super::program::View;

    #[test]
    fn an_emulated_board_is_a_board() {
        let image = require_qemu_arm().and_then(|()| Emulated::OLIMEX.image("", None));
        if if_installed(image).is_none() {
            return;
        }
        let mut view = View::start("box-flat --emulate --timeout 60");
        let mut client = view.client();
        let source = &client.hello["source"];
        assert_eq!(
            (&source["name"], &source["emulated"]),
            (&json!("olimex-stm32-h405"), &json!(true))
        );
        let pressed = lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
        assert_eq!(pressed["frame"]["state"], "edge");
        assert_eq!(pressed["reference"]["state"], "edge");
        let emulators = children(view.child.id());
        assert_eq!(emulators.len(), 1);
        view.interrupt();
        assert!(view.child.wait().expect("it ends").success());
        assert!(!emulators[0].exists(), "the emulator ends with it");
    }

    fn children(id: u32) -> Vec<PathBuf> {
        let all = fs::read_dir("/proc").expect("the processes").flatten();
        let is_child = |process: &PathBuf| {
            let status = fs::read_to_string(process.join("status")).unwrap_or_default();
            status.lines().any(|line| line == format!("PPid:\t{id}"))
        };
        all.map(|entry| entry.path()).filter(is_child).collect()
    }
}
