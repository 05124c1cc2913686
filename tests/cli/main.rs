//! The program as people run it: flags, files, streams, exit codes and messages.

mod batch;
mod bench;
mod check;
mod compare;
mod completions;
mod cost;
mod engine;
mod exit_code;
mod folder;
mod man;
mod message;
mod offered;
mod output;
mod pixel;
mod region;
mod talk;
mod version;
