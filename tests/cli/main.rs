//! The program as people run it: flags, files, streams, exit codes and messages.

mod batch;
mod bench;
mod check;
mod compare;
mod cost;
mod engine;
mod exit_code;
mod folder;
mod message;
mod output;
mod pixel;
mod region;
mod talk;
