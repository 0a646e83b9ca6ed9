//! What is malformed, too large, too much, or from elsewhere is refused, and changes nothing.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};
use tungstenite::Message;

use super::program::{Client, PATIENCE, View};
use crate::common::Folder;

#[test]
fn malformed_messages_are_answered_and_dropped() {
    let view = View::start("box-flat");
    let mut client = view.client();
    let long = format!(
        "{{\"type\": \"scene\", \"name\": \"{}\"}}",
        "x".repeat(5000)
    );
    for bad in [
        "",
        "{",
        r#"{"type": "set", "parameters": {"static": -1}}"#,
        r#"{"type": "set", "parameters": {"static": 0.1}}"#,
        r#"{"type": "set", "parameters": {"stiffness_translation": 0}}"#,
        r#"{"type": "seek", "seconds": 1}"#,
        r#"{"type": "replay", "what": "recording"}"#,
        r#"{"type": "replay", "what": "upload"}"#,
        &"[".repeat(4000),
        &long,
    ] {
        client.send(bad);
        let answer = client.until(|message| message["type"] == "error");
        assert!(
            answer["message"]
                .as_str()
                .is_some_and(|text| !text.is_empty()),
            "{bad}"
        );
        assert!(answer["id"].is_null());
    }
    client
        .socket
        .send(Message::binary(vec![0; 100]))
        .expect("it is taken");
    client.until(|message| message["type"] == "error");
    // What was refused changed nothing.
    let mut other = view.client();
    let state = other.state(|_| true);
    assert_eq!(
        state["parameters"],
        json!({"stiffness_translation": 500.0, "stiffness_rotation": 0.5, "static": 0.5, "dynamic": 0.3, "memory": null, "weight": 0.0})
    );
    client.done(json!({"type": "reset"}));
}

/// What it said beyond is not read, and it has to go; the others go on.
#[test]
fn a_client_that_says_more_than_2000_messages_a_second_has_to_go() {
    let view = View::start("box-flat");
    let mut other = view.client();
    let mut client = view.client();
    client.done(json!({"type": "pause", "value": true}));
    let flood = Message::text(r#"{"type": "let-go"}"#);
    let is_taken = |client: &mut Client| client.socket.write(flood.clone()).is_ok();
    // As many as it takes until nothing is taken any more.
    while is_taken(&mut client) && client.socket.flush().is_ok() {}
    other.state(|state| state["clients"] == 1);
    other.done(json!({"type": "pause", "value": false}));
    other.frame(|frame| frame["tick"].as_u64() > Some(5));
}

/// What is said of it, before it has to go.
#[test]
fn a_client_that_says_too_much_is_warned() {
    let view = View::start("box-flat");
    let mut client = view.client();
    // A second may begin in between.
    for _ in 0..4100 {
        client.send(r#"{"type": "let-go"}"#);
    }
    client.until(|message| {
        message["message"]
            .as_str()
            .is_some_and(|text| text.contains("allowed: 2000 a second; the connection ends"))
    });
    while !matches!(client.socket.read(), Ok(Message::Close(_)) | Err(_)) {}
}

/// Who opens connections and says half of something, or nothing, locks nobody out.
#[test]
fn half_requests_and_silent_sockets_lock_nobody_out() {
    let view = View::start("box-flat");
    let mut client = view.client();
    client.done(json!({"type": "pause", "value": false}));
    let connect = |text: &[u8]| {
        let mut stream = TcpStream::connect(&view.place).expect("a connection");
        // One that has to go already does not take it.
        let _ = stream.write_all(text);
        stream
    };
    let upgrade = format!(
        "GET /ws HTTP/1.1\r\nHost: {}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n",
        view.place
    );
    for text in ["", "GET / HTTP/1.1\r\nHost: 127", &upgrade] {
        let held: Vec<TcpStream> = (0..300).map(|_| connect(text.as_bytes())).collect();
        assert_eq!(view.http("GET", "/", "", b"").status, 200, "{text:?}");
        view.client().frame(|_| true);
        // The first ones had to make room.
        let mut bytes = Vec::new();
        let mut first = &held[0];
        first.set_read_timeout(Some(PATIENCE)).expect("a time-out");
        let _ = first.read_to_end(&mut bytes);
    }
    client.done(json!({"type": "reset"}));
}

/// The head of an upload of a path with so many bytes, and what it begins with.
fn half_upload(view: &View, length: usize) -> String {
    format!(
        "POST /upload?name=a.csv HTTP/1.1\r\nHost: {}\r\nContent-Length: {length}\r\n\r\nt,x,y,phi\n",
        view.place
    )
}

/// What uploads that do not end hold in memory is bounded, however many there are, and an upload that is whole is taken soon.
#[cfg(target_os = "linux")]
#[test]
fn half_uploads_take_little_memory_and_lock_nobody_out() {
    const LARGEST: usize = 16 << 20;
    let view = View::start("box-flat");
    let half = half_upload(&view, LARGEST);
    let rest = vec![b'#'; LARGEST / 2];
    let connect = || {
        let mut stream = TcpStream::connect(&view.place).expect("a connection");
        // Those that wait are not read.
        let time = std::time::Duration::from_millis(100);
        stream.set_write_timeout(Some(time)).expect("a time-out");
        let _ = stream.write_all(half.as_bytes());
        let _ = stream.write_all(&rest);
        stream
    };
    let held: Vec<TcpStream> = (0..60).map(|_| connect()).collect();
    let status = std::fs::read_to_string(format!("/proc/{}/status", view.child.id()));
    let status = status.expect("the program runs");
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let most = most.and_then(|most| most.trim().strip_suffix(" kB"));
    let most: usize = most.and_then(|kib| kib.parse().ok()).expect("a number");
    // Two whole ones, and what the program has without.
    assert!(most < 2 * (LARGEST >> 10) + 60_000, "{most} KiB");
    let path = b"t,x,y,phi\n0,0,0,0\n1,0,0,0\n";
    let begun = std::time::Instant::now();
    while view.http("POST", "/upload?name=a.csv", "", path).status != 200 {
        assert!(begun.elapsed() < PATIENCE, "no place for an upload");
    }
    drop(held);
}

#[test]
fn a_request_that_does_not_come_to_its_end_is_closed() {
    let view = View::start("box-flat");
    let half_page = format!(
        "POST / HTTP/1.1\r\nHost: {}\r\nContent-Length: 9\r\n\r\na",
        view.place
    );
    for text in [
        "",
        "GET / HTTP/1.1\r\nHost: 127",
        &half_upload(&view, 1000),
        &half_page,
    ] {
        let mut stream = TcpStream::connect(&view.place).expect("a connection");
        stream.write_all(text.as_bytes()).expect("taken");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time-out");
        let mut said = Vec::new();
        let ended = stream.read_to_end(&mut said);
        assert!(ended.is_ok(), "{text:?}: {ended:?}");
    }
}

#[test]
fn other_pages_are_refused() {
    let view = View::start("box-flat");
    let own = format!("http://{}", view.place);
    assert!(view.client_of(Some(&own)).is_ok());
    for foreign in ["http://example.org", "null", "http://127.0.0.1:1"] {
        let refusal = view.client_of(Some(foreign)).err().expect("a refusal");
        assert!(refusal.contains("403"), "{refusal}");
        let origin = format!("Origin: {foreign}\r\n");
        let path = b"t,x,y,phi\n0,0,0,0\n";
        assert_eq!(
            view.http("POST", "/upload?name=a.csv", &origin, path)
                .status,
            403
        );
    }
    let rebound = view.http("GET", "/", "Host: example.org\r\n", b"").status;
    assert_eq!(rebound, 403);
}

#[test]
fn files_have_their_types_and_a_policy() {
    let view = View::start("box-flat");
    let page = view.http("GET", "/", "", b"");
    assert_eq!(page.status, 200);
    // Its own host alone, and in no frame.
    let policy = format!(
        "content-security-policy: default-src 'self'; connect-src 'self' ws://{}; frame-ancestors 'none'\r\n",
        view.place
    );
    for part in [
        "content-type: text/html; charset=utf-8",
        &policy,
        "x-frame-options: deny",
        "x-content-type-options: nosniff",
        "cache-control: no-store",
    ] {
        assert!(page.head.contains(part), "{part}: {}", page.head);
    }
    for nowhere in [
        "/Cargo.toml",
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/recording/trace.jsonl",
    ] {
        assert_eq!(view.http("GET", nowhere, "", b"").status, 404, "{nowhere}");
    }
    let headless = View::start("box-flat --headless");
    assert_eq!(headless.http("GET", "/", "", b"").status, 404);
    headless.client().frame(|_| true);
}

/// Of a path `a.csv` whose last record, in line 3, is at 3601 s.
const TOO_LONG: &str = "a.csv, line 3: the path is 3601.0 s long, allowed: up to 3600 s";

#[test]
fn paths_that_cannot_be_used_are_refused_with_a_message() {
    let view = View::start("box-flat");
    for (name, path) in [
        ("a.csv", "t,x,y,phi\n0,0,0,0\n0,0,0,0\n"),
        ("a.csv", "who,knows\n1,2\n"),
        ("a.csv", "t,x,y,phi\n0,0,0,0\n1e9,0,0,0\n"),
        ("a.csv", "t,x,y,phi\n0,0,0,0\n1e300,0,0,0\n"),
        ("a.exe", "t,x,y,phi\n0,0,0,0\n"),
        ("", "t,x,y,phi\n0,0,0,0\n"),
        ("a.csv", "\u{0}"),
    ] {
        let answer = view.http("POST", &format!("/upload?name={name}"), "", path.as_bytes());
        assert_eq!(answer.status, 400, "{name} {path}");
        let refusal: Value = serde_json::from_slice(&answer.body).expect("JSON");
        assert!(refusal["message"].is_string(), "{refusal}");
    }
    let long = "t,x,y,phi\n0,0,0,0\n3601,0,0,0\n";
    let answer = view.http("POST", "/upload?name=a.csv", "", long.as_bytes());
    let refusal: Value = serde_json::from_slice(&answer.body).expect("JSON");
    let message = refusal["message"].as_str().expect("a text");
    assert_eq!(message.lines().next(), Some(TOO_LONG), "{message}");
    assert_eq!(
        view.http("POST", "/upload?name=a.csv", "", &[b'#'; (16 << 20) + 1])
            .status,
        413
    );
}

#[test]
fn a_port_that_is_taken_is_said_and_the_next_one_is_served() {
    let first = View::start("box-flat");
    let folder = Folder::new();
    let mut second = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(["view", "--listen", &first.place])
        .current_dir(folder.file(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let line = first_line(second.stderr.take().expect("its errors"));
    end(second);
    let (_, port) = first.place.split_once(':').expect("a port");
    assert!(line.contains(port) && line.contains("taken"), "{line}");
}

/// What a program says first.
fn first_line(said: impl Read) -> String {
    let mut line = String::new();
    BufReader::new(said).read_line(&mut line).expect("a line");
    line
}

fn end(mut child: Child) {
    child.kill().expect("it runs");
    child.wait().expect("it ends");
}

#[test]
fn without_arguments_the_page_is_served() {
    let folder = Folder::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .current_dir(folder.file(""))
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let line = first_line(child.stdout.take().expect("its output"));
    end(child);
    assert!(line.starts_with("http://127.0.0.1:"), "{line}");
}

#[test]
fn what_cannot_be_viewed_ends_with_status_2() {
    let folder = Folder::new();
    folder.write("bad.toml", "[body]\n");
    folder.write("a.csv", "t,x,y,phi\n0,0,0,0\n3601,0,0,0\n");
    for (options, expected) in [
        ("nowhere", "nowhere: no such file, allowed: "),
        ("bad.toml", "bad.toml, line 1: "),
        ("--hand none.csv", "none.csv: cannot be read"),
        ("--hand a.csv", TOO_LONG),
        ("--osc 127.0.0.1:0", "--osc 127.0.0.1:0: "),
        (
            "--osc 127.0.0.1:0",
            ", allowed: HOST:PORT, the port from 1 to 65535",
        ),
        ("--opentrack 127.0.0.1:0", "--opentrack 127.0.0.1:0: "),
        ("--opentrack 127.0.0.1:port", "allowed: HOST:PORT, "),
        ("--osc-rate 0", "--osc-rate"),
    ] {
        folder.refused(&format!("view --listen 127.0.0.1:0 {options}"), &[expected]);
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_it_and_the_clients_are_notified() {
    let mut view = View::start("box-flat");
    let mut client = view.client();
    client.frame(|_| true);
    view.interrupt();
    let closed = loop {
        match client.socket.read() {
            Ok(Message::Close(frame)) => break frame.map(|frame| u16::from(frame.code)),
            Ok(_) => {}
            Err(error) => panic!("{error}"),
        }
    };
    assert_eq!(closed, Some(1001));
    drop(client);
    assert!(view.child.wait().expect("it ends").success());
}
