//! The program as people run it: flags, files, streams, exit codes and messages.

mod batch;
mod bench;
mod cameras;
mod check;
mod compare;
mod completions;
mod cost;
mod engine;
mod exit_code;
mod files;
mod folder;
mod formats;
mod help;
mod limits;
mod man;
mod merge;
mod message;
mod offered;
mod output;
mod pixel;
mod region;
mod talk;
mod version;
