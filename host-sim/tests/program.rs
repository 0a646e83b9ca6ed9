//! The program as its users meet it. No verdict hangs on how fast anything is.

mod common;

mod program {
    mod board;
    mod command;
    mod ended;
    mod hand_paths;
    mod helped;
    mod insertion;
    mod judged;
    mod malformed;
    mod obstacles;
    mod outputs;
    mod replay;
    mod slides;
    mod sweep;
    mod tutorial;
    mod view;
}
