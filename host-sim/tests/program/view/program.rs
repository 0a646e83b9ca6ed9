//! The program in a folder of its own, and clients of its socket.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::http::HeaderValue;
use tungstenite::{Message, WebSocket};

use crate::common::{Folder, text};
#[cfg(unix)]
use crate::common::{Signal, send};

/// Whatever is waited for comes within this, or not at all.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct View {
    pub(crate) child: Child,
    pub(crate) place: String,
    /// Where it runs.
    folder: Option<Folder>,
    output: BufReader<ChildStdout>,
}

impl View {
    /// `stiction view` with these arguments, on a free port.
    pub(crate) fn start(line: &str) -> Self {
        Self::in_folder(Folder::new(), line)
    }

    pub(crate) fn in_folder(folder: Folder, line: &str) -> Self {
        let program = Command::new(env!("CARGO_BIN_EXE_stiction"));
        Self::by(program, folder, line)
    }

    /// What it says on standard error is in `errors.txt`.
    pub(crate) fn with_errors(line: &str) -> Self {
        let folder = Folder::new();
        let mut program = Command::new(env!("CARGO_BIN_EXE_stiction"));
        let errors = std::fs::File::create(folder.file("errors.txt")).expect("a file");
        program.stderr(errors);
        Self::by(program, folder, line)
    }

    /// Its files may be so long (blocks of 512 bytes): then the system takes no more, as where a disk is full.
    #[cfg(unix)]
    pub(crate) fn with_room(blocks: u32, folder: Folder, line: &str) -> Self {
        let mut shell = Command::new("sh");
        let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
        shell.args(["-c", &limit, env!("CARGO_BIN_EXE_stiction")]);
        Self::by(shell, folder, line)
    }

    fn by(mut program: Command, folder: Folder, line: &str) -> Self {
        // Not among those of whoever runs the tests.
        let own = if line.contains("--recordings") {
            ""
        } else {
            "--recordings recordings"
        };
        let mut child = program
            .args(format!("view --listen 127.0.0.1:0 {own} {line}").split_whitespace())
            .current_dir(folder.file(""))
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut line = String::new();
        let output = child.stdout.take().expect("its output");
        let mut output = BufReader::new(output);
        output.read_line(&mut line).expect("a line of text");
        let place = line.split_whitespace().next().unwrap_or_default();
        let place = place.trim_start_matches("http://");
        let place = place.trim_start_matches("ws://");
        let place = place.trim_end_matches("/ws").trim_end_matches('/');
        assert!(!place.is_empty(), "{line:?}");
        Self {
            child,
            place: place.to_owned(),
            folder: Some(folder),
            output,
        }
    }

    /// The next line of its output.
    pub(crate) fn line(&mut self) -> String {
        let mut line = String::new();
        self.output.read_line(&mut line).expect("a line of text");
        line
    }

    /// Where it runs.
    pub(crate) fn folder(&self) -> &Folder {
        self.folder.as_ref().expect("its folder")
    }

    /// As kill -9; its folder.
    pub(crate) fn kill(mut self) -> Folder {
        self.child.kill().expect("it runs");
        self.child.wait().expect("it ends");
        self.folder.take().expect("its folder")
    }

    #[cfg(unix)]
    pub(crate) fn interrupt(&self) {
        send(Signal::SIGINT, &self.child);
    }

    /// A client that is connected and has received hello.
    pub(crate) fn client(&self) -> Client {
        self.client_of(None).expect("a connection")
    }

    /// The state as a client gets it that comes now.
    pub(crate) fn state(&self) -> Value {
        self.client().state(|_| true)
    }

    /// A client that comes from a page.
    pub(crate) fn client_of(&self, origin: Option<&str>) -> Result<Client, String> {
        let stream = TcpStream::connect(&self.place).map_err(|error| error.to_string())?;
        stream.set_read_timeout(Some(PATIENCE)).expect("a time-out");
        stream.set_nodelay(true).expect("a prompt stream");
        let url = format!("ws://{}/ws", self.place);
        let mut request = url.into_client_request().expect("a request");
        if let Some(origin) = origin {
            let origin = HeaderValue::from_str(origin).expect("a header");
            request.headers_mut().insert("Origin", origin);
        }
        let (socket, _) =
            tungstenite::client(request, stream).map_err(|error| error.to_string())?;
        let mut client = Client {
            socket,
            hello: Value::Null,
            last_id: 0,
            passed: Vec::new(),
        };
        client.hello = client.next();
        assert_eq!(client.hello["type"], "hello");
        Ok(client)
    }

    /// Status, head and body of an answer to a request.
    pub(crate) fn http(&self, method: &str, path: &str, extra: &str, body: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(&self.place).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time-out");
        let host = match extra.starts_with("Host:") {
            true => String::new(),
            false => format!("Host: {}\r\n", self.place),
        };
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{host}Connection: close\r\nContent-Length: {}\r\n{extra}\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes()).expect("a request");
        // A server that refuses what is too long need not read it.
        let _ = stream.write_all(body);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let end = answer.windows(4).position(|bytes| bytes == b"\r\n\r\n");
        let end = end.expect("a head and a body");
        let head = text(&answer[..end]).to_lowercase();
        let status = head.split(' ').nth(1).expect("a status");
        Answer {
            status: status.parse().expect("a number"),
            head,
            body: answer[end + 4..].to_vec(),
        }
    }

    /// The body of what is there.
    pub(crate) fn get(&self, path: &str) -> Vec<u8> {
        let answer = self.http("GET", path, "", b"");
        assert_eq!(answer.status, 200, "{path}: {}", text(&answer.body));
        answer.body
    }
}

impl Drop for View {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub(crate) struct Answer {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

pub(crate) struct Client {
    pub(crate) socket: WebSocket<TcpStream>,
    pub(crate) hello: Value,
    last_id: u64,
    /// States that came before the answer to what was asked last.
    passed: Vec<Value>,
}

impl Client {
    pub(crate) fn say(&mut self, message: &Value) {
        self.send(&message.to_string());
    }

    pub(crate) fn send(&mut self, text: &str) {
        self.socket
            .send(Message::text(text))
            .expect("a message is taken");
    }

    pub(crate) fn next(&mut self) -> Value {
        loop {
            match self.socket.read().expect("a message") {
                Message::Text(text) => return serde_json::from_str(&text).expect("JSON"),
                Message::Close(_) => panic!("the connection was closed"),
                _ => {}
            }
        }
    }

    /// The first message that `pick` takes.
    pub(crate) fn until(&mut self, mut pick: impl FnMut(&Value) -> bool) -> Value {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            let message = self.next();
            if pick(&message) {
                return message;
            }
        }
        panic!("what was waited for did not come")
    }

    /// The next frame that `pick` takes.
    pub(crate) fn frame(&mut self, mut pick: impl FnMut(&Value) -> bool) -> Value {
        self.until(|message| message["type"] == "frame" && pick(message))
    }

    /// The first state that `pick` takes, of those since something was asked.
    pub(crate) fn state(&mut self, mut pick: impl FnMut(&Value) -> bool) -> Value {
        let passed = std::mem::take(&mut self.passed);
        if let Some(state) = passed.into_iter().find(&mut pick) {
            return state;
        }
        self.until(|message| message["type"] == "state" && pick(message))
    }

    /// Sends a message; the answer: nothing, or why it was refused.
    pub(crate) fn ask(&mut self, mut message: Value) -> Result<(), String> {
        self.last_id += 1;
        let id = self.last_id;
        message["id"] = json!(id);
        self.say(&message);
        // What changed may be shown before the answer.
        let mut passed = Vec::new();
        let answer = self.until(|message| {
            if message["type"] == "state" {
                passed.push(message.clone());
            }
            message["id"] == json!(id)
        });
        self.passed = passed;
        match answer["type"].as_str() {
            Some("done") => Ok(()),
            _ => Err(answer["message"].as_str().expect("a message").to_owned()),
        }
    }

    /// As [`Self::ask`], for what is not refused.
    pub(crate) fn done(&mut self, message: Value) {
        let text = message.to_string();
        assert_eq!(self.ask(message), Ok(()), "{text}");
    }

    /// The hand goes from pose to pose in `count` samples, each after the frame that contains the one before.
    pub(crate) fn lead(&mut self, from: [f64; 3], to: [f64; 3], count: u32) {
        for k in 1..=count {
            let part = f64::from(k) / f64::from(count);
            let pose = [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * part);
            let sent = k + 1;
            self.say(&json!({"type": "hand", "pose": pose, "held": true, "sent": sent}));
            self.frame(|frame| frame["echo"] == json!(sent));
        }
    }
}
