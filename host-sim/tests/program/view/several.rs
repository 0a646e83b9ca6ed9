//! Several clients: who holds the hand, and what one that does not read costs the others.

use serde_json::json;

use super::program::View;

#[test]
fn one_client_holds_the_hand_until_it_lets_go_or_is_gone() {
    let view = View::start("box-flat");
    let (mut first, mut second) = (view.client(), view.client());
    second.state(|state| state["clients"] == 2);
    let number = |client: &super::program::Client| client.hello["you"].clone();
    let hand = |y: f64| json!({"type": "hand", "pose": [0.0, y, 0.0], "held": true});
    first.done(hand(0.07));
    let held = json!({"by": "page", "client": number(&first)});
    second.state(|state| state["hand"] == held);
    let refusal = second.ask(hand(0.5)).expect_err("the first one holds it");
    assert!(refusal.contains("client 1"), "{refusal}");
    second.done(json!({"type": "let-go"}));
    assert!(second.ask(hand(0.5)).is_err());
    first.done(json!({"type": "let-go"}));
    second.done(hand(0.08));
    let held = json!({"by": "page", "client": number(&second)});
    first.state(|state| state["hand"] == held);
    drop(second);
    let state = first.state(|state| state["clients"] == 1);
    assert_eq!(state["hand"], json!({"by": null, "client": null}));
    first.done(hand(0.07));
}

#[test]
fn both_see_the_same_and_an_echo_goes_to_its_sender() {
    let view = View::start("box-flat");
    let (mut first, mut second) = (view.client(), view.client());
    first.say(&json!({"type": "hand", "pose": [0.01, 0.07, 0.0], "held": true, "sent": 4.5}));
    let own = first.frame(|frame| !frame["echo"].is_null());
    assert_eq!(own["echo"], 4.5);
    first.done(json!({"type": "pause", "value": true}));
    second.state(|state| state["paused"] == true);
    first.done(json!({"type": "step", "ticks": 100}));
    let last = first.frame(|_| true);
    // Paused: the last frame of both is the same one.
    let mut tick = last["tick"].clone();
    let mut seen = second.frame(|_| true);
    while seen["tick"] != tick {
        if seen["tick"].as_u64() < tick.as_u64() {
            seen = second.frame(|_| true);
        } else {
            tick = first.frame(|frame| frame["tick"] == seen["tick"])["tick"].clone();
        }
    }
    assert!(seen["echo"].is_null());
}

#[test]
fn a_client_that_never_reads_costs_the_solver_nothing() {
    let view = View::start("box-flat");
    let mut stalled = view.client();
    stalled.say(&json!({"type": "rate", "value": 1000}));
    let mut other = view.client();
    // What the system keeps for one that does not read, and how fast it fills, differ: longer and longer.
    let lost = [4_000, 8_000, 16_000].into_iter().find(|wait| {
        // One that says nothing has to go.
        stalled.say(&json!({"type": "rate", "value": 1000}));
        let first = other.frame(|_| true)["tick"].as_u64().expect("a number");
        let mut received = 0;
        let last = other.frame(|frame| {
            received += 1;
            frame["tick"].as_u64() > Some(first + wait)
        });
        assert!(last["skipped"].as_u64() < Some(received), "it reads");
        assert!(last["counts"]["ticks"].as_u64() > Some(first + wait));
        let now = last["tick"].as_u64();
        // The frames that wait for it are old; then it receives the newest, and the number of frames it lost.
        let message = stalled.frame(|frame| frame["tick"].as_u64() >= now);
        message["skipped"].as_u64() > Some(100)
    });
    assert!(lost.is_some(), "it lost frames");
}
