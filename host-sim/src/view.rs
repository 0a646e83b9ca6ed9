//! `stiction view`: the solver in real time with a page, a socket and UDP, as described in `host-sim/VIEW.md`.
//!
//! ```text
//! page, programs ═ connections ─ server ─ client ─┐ orders          ┌─ client ═ page, programs
//! trackers ═ inward ──────────────────────────────┴─ engine ─ feed ─┴─ outward ═ renderers
//!                                                      ├─ stiction-live: the solver, the parallel reference, the hand
//!                                                      ├─ remote, answers, mirror: a board instead of the solver
//!                                                      └─ recording, recorder, archive, resume
//! ```
//!
//! The engine has a thread of its own and waits for nobody. During a recording, every tick is in the file before anybody sees it.

mod answers;
mod archive;
mod change;
mod client;
mod connections;
mod endpoints;
mod engine;
mod feed;
mod inward;
mod mirror;
mod orders;
mod osc;
mod outward;
mod page;
mod pictures;
mod publish;
mod realtime;
mod recorder;
mod recording;
mod reload;
mod remote;
mod resume;
mod retained;
mod server;
mod upload;
mod written;

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::Receiver;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use clap::Args;
use stiction_core::Evolution;
use stiction_live::body::{Setting, without_obstacles};
use stiction_live::number::Number;
use stiction_live::replay::Way;
use stiction_live::scenes;
use stiction_live::stage::Stage;
use stiction_scene::{HandPath, InputError};
use tokio::sync::{mpsc, watch};

use crate::board::{BoardError, ConnectArgs, Identity, LiveBoard, PLACE};
use crate::input::{self, open_scene};
use crate::options::{evolution_parser, parse_end, parse_listen, parse_rate};
use crate::report;
use crate::shell::scene_completer;
use crate::stop;
use archive::Archive;
use endpoints::{Endpoints, listen};
use engine::{Engine, Surroundings};
use feed::SharedFeed;
use orders::Order;
use reload::Watch;
use remote::Remote;
use retained::Retained;
use server::Hub;

/// The default scene.
const SCENE: &str = "drag";
/// Maximum number of orders that wait for the solver.
const ORDERS: usize = 1024;
/// Maximum number of lines that wait for the terminal: of recordings that begin faster than it prints, some are not reported.
const NOTES: usize = 64;
/// Interval of the checks for Ctrl-C.
const BREATH: Duration = Duration::from_millis(50);
/// Time that connections have to end by themselves.
const FAREWELL: Duration = Duration::from_secs(1);

/// The arguments of `stiction view`.
#[derive(Args, Clone, Debug)]
pub struct ViewArgs {
    /// Scene file (TOML), or the name of a bundled scene
    #[arg(default_value = SCENE, add = scene_completer())]
    scene: PathBuf,
    /// Recorded hand path (csv, tum, txt) that the hand follows from the beginning
    #[arg(long, value_name = "FILE")]
    hand: Option<PathBuf>,
    /// Place the path of --hand over the scene: it begins where the body is held at its start, and units, plane and angles that look wrong
    /// are mended; the keys that do the same are printed
    #[arg(long, requires = "hand")]
    fit: bool,
    /// A board instead of the solver in this program.
    #[command(flatten)]
    connect: ConnectArgs,
    /// Number type of the solver; a board has its own
    #[arg(long, value_enum, default_value_t = Number::F32, conflicts_with = PLACE)]
    number: Number,
    /// path: events are found along the hand's straight line between two frames; frame: from the first event
    /// of a frame the hand jumps to its end
    #[arg(long, default_value = "path", value_parser = evolution_parser())]
    evolution: Evolution,
    /// Where the page is, a port of this computer or ADDR:PORT; the next free port where that is taken. Everyone who reaches
    /// another address than this computer's own can hold the hand
    #[arg(long, value_name = "ADDR:PORT", default_value = "127.0.0.1:8405", value_parser = parse_listen)]
    listen: SocketAddr,
    /// Folder for recordings, instead of the system's folder for data of programs
    #[arg(long, value_name = "FOLDER")]
    recordings: Option<PathBuf>,
    /// No page: only the WebSocket, OSC and OpenTrack
    #[arg(long)]
    headless: bool,
    /// Send poses by OSC over UDP
    #[arg(long, value_name = "HOST:PORT", value_parser = parse_end)]
    osc: Option<String>,
    /// Poses per second sent by OSC (1 to 1000)
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = parse_pose_rate, allow_negative_numbers = true)]
    osc_rate: f64,
    /// Take the hand by OSC on this UDP port
    #[arg(long, value_name = "PORT")]
    osc_in: Option<u16>,
    /// Send poses as OpenTrack does, over UDP
    #[arg(long, value_name = "HOST:PORT", value_parser = parse_end)]
    opentrack: Option<String>,
    /// Poses per second sent as OpenTrack does (1 to 1000)
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = parse_pose_rate, allow_negative_numbers = true)]
    opentrack_rate: f64,
    /// Take the hand from OpenTrack on this UDP port; a seventh double of a packet is the switch
    #[arg(long, value_name = "PORT")]
    opentrack_in: Option<u16>,
}

fn parse_pose_rate(text: &str) -> Result<f64, String> {
    match parse_rate(text) {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("allowed: 1 to 1000".to_owned()),
    }
}

/// The reason why there is nothing to view.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ViewError {
    #[error(transparent)]
    Input(#[from] InputError),
    #[error("{0}")]
    Scene(String),
    /// The folder for recordings cannot be written.
    #[error("{0}")]
    Recordings(String),
    #[error("{address}: {error}")]
    Address { address: String, error: io::Error },
    #[error("{option} {address}: {error}, allowed: HOST:PORT, the port from 1 to 65535")]
    Renderer {
        option: &'static str,
        address: String,
        error: io::Error,
    },
    #[error(transparent)]
    System(#[from] io::Error),
    #[error(transparent)]
    Board(#[from] BoardError),
    /// The solver ended: a board will not come back, or its thread failed.
    #[error("{0}")]
    Solver(String),
}

/// The solver's thread, and why it ended.
type Solver = JoinHandle<Result<(), String>>;

/// Serves until Ctrl-C.
pub(crate) fn view(args: &ViewArgs) -> Result<(), ViewError> {
    stop::listen();
    let (notes, lines) = std::sync::mpsc::sync_channel(NOTES);
    let archive = Archive::new(args.recordings.clone()).map_err(ViewError::Recordings)?;
    let feed = Arc::new(SharedFeed::default());
    let surroundings = Surroundings {
        feed: Arc::clone(&feed),
        archive: archive.clone(),
        notes: notes.clone(),
    };
    let engine = prepared(args, surroundings)?;
    let number = engine.live.pair.setting.number;
    let board = engine.board.as_ref().map(|board| board.identity().clone());
    let scenes = engine.live.offers(board.is_none());
    let listener = listen(args.listen)?;
    let place = listener.local_addr()?;
    let (orders, inbox) = mpsc::channel(ORDERS);
    let ends = Endpoints::open(args, place)?;
    let requests = orders.clone();
    let ending = Arc::new(AtomicBool::new(false));
    let solver = started(engine, inbox, Arc::clone(&ending))?;
    let (stopper, stop) = watch::channel(false);
    let hub = Arc::new(Hub {
        feed,
        orders,
        scenes,
        board,
        stop,
        clients: AtomicU32::new(0),
        uploads: upload::places(),
        scene_places: upload::places(),
        retained: Retained::default(),
    });
    greet(args, place, hub.board.as_ref());
    if let Some(file) = own_file(&args.scene) {
        reload::begin(Watch {
            file: file.to_owned(),
            number,
            has_board: hub.board.is_some(),
            orders: requests.clone(),
            notes,
        });
    }
    thread::spawn(move || recorder::look_back(&archive, &requests));
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    let watched = Watched {
        stopper,
        solver: &solver,
        lines: &lines,
    };
    let result = runtime.block_on(serve(args, listener, ends, hub, watched));
    ending.store(true, Ordering::Relaxed);
    let ended = solver.join();
    lines.try_iter().for_each(|note| report::print(&note));
    runtime.shutdown_timeout(FAREWELL);
    let ended = ended.unwrap_or_else(|_| Err("the solver broke".to_owned()));
    result.and(ended.map_err(ViewError::Solver))
}

fn started(
    engine: Engine,
    inbox: mpsc::Receiver<Order>,
    ending: Arc<AtomicBool>,
) -> io::Result<Solver> {
    let thread = thread::Builder::new().name("solver".to_owned());
    thread.spawn(move || {
        realtime::hurry();
        engine.run(inbox, &ending)
    })
}

/// The solver with its scene, before its first tick.
fn prepared(args: &ViewArgs, surroundings: Surroundings) -> Result<Engine, ViewError> {
    let stage = Stage::new(open_scene(&args.scene, args.number)?)?;
    // This error names the key and the line.
    match args.connect.is_wanted() {
        true => without_obstacles(&stage.scene)?,
        false => stage.scene.scene::<f64>().map(drop)?,
    }
    let board = match args.connect.is_wanted() {
        true => {
            let board = LiveBoard::connect(&args.connect, &stage.scene, args.evolution)?;
            Some(Remote::new(board))
        }
        false => None,
    };
    let number = board.as_ref().map(|board| board.identity().number);
    let setting = Setting {
        scene: Arc::clone(&stage.scene),
        number: number.unwrap_or(args.number),
        evolution: args.evolution,
    };
    let own = own_file(&args.scene).map(|_| stage.clone());
    let scene = Arc::clone(&stage.scene);
    report::notes(&scene.notes);
    let mut engine = Engine::new(stage, &setting, surroundings).map_err(ViewError::Scene)?;
    Arc::make_mut(&mut engine.live.own).extend(own);
    engine.board = board;
    engine.is_led =
        [args.osc_in, args.opentrack_in].iter().any(Option::is_some) || args.hand.is_some();
    if let Some(file) = &args.hand {
        let (path, notes) = input::hand_path(&scene, file, args.fit)?;
        report::notes(notes);
        let (name, way) = (file.file_name(), Way::Path(Arc::new(path)));
        way.check()
            .map_err(|problem| HandPath::error_at_end(file, &problem))?;
        let name = name.unwrap_or_default().to_string_lossy();
        engine.upload = Some((name.into_owned(), way));
        let follow = engine
            .upload()
            .and_then(|change| engine.apply(change.into()));
        follow.map_err(ViewError::Scene)?;
    }
    Ok(engine)
}

/// The file of a scene that is not a bundled one.
fn own_file(scene: &Path) -> Option<&Path> {
    let is_bundled = !scene.exists() && scenes::find(scene).is_some();
    (!is_bundled).then_some(scene)
}

/// Prints the address of the page, and where the solver runs.
fn greet(args: &ViewArgs, place: SocketAddr, board: Option<&Identity>) {
    let what = match args.headless {
        true => format!("ws://{place}/ws"),
        false => format!("http://{place}/"),
    };
    let board = board.map_or_else(String::new, |board| {
        format!("the solver is on {}, {}\n", board.name, board.place)
    });
    report::print(&format!("{what}   Ctrl-C ends it\n{board}"));
}

struct Watched<'a> {
    /// Signals the end to all tasks.
    stopper: watch::Sender<bool>,
    solver: &'a Solver,
    /// The solver's messages for the terminal.
    lines: &'a Receiver<String>,
}

/// Runs until Ctrl-C, or until the solver ends.
async fn serve(
    args: &ViewArgs,
    listener: TcpListener,
    ends: Endpoints,
    hub: Arc<Hub>,
    watched: Watched<'_>,
) -> Result<(), ViewError> {
    for (socket, format, rate) in ends.out {
        let feed = Arc::clone(&hub.feed);
        tokio::spawn(outward::send(socket, format, feed, rate));
    }
    for (socket, format) in ends.inward {
        tokio::spawn(inward::receive(socket, format, hub.orders.clone()));
    }
    let (stop, tidied) = (hub.stop.clone(), Arc::clone(&hub));
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let server = connections::serve(listener, server::router(hub, !args.headless), stop);
    let end = async {
        while !stop::asked() && !watched.solver.is_finished() {
            watched
                .lines
                .try_iter()
                .for_each(|note| report::print(&note));
            tidied.tidy();
            tokio::time::sleep(BREATH).await;
        }
        let _ = watched.stopper.send(true);
        tokio::time::sleep(FAREWELL).await;
    };
    tokio::select! {
        () = server => {}
        () = end => {}
    }
    Ok(())
}
