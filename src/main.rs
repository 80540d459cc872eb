//! The whole story: what was typed, what it means, and the rooms each command passes through.

use std::process::ExitCode;

use clap::Parser;
use kynch::cli::actions::{explain, for_each, make_report, run, show_plan, verify};
use kynch::cli::arguments::Arguments;
use kynch::cli::command::{Command, completions};
use kynch::cli::console::Console;
use kynch::cli::extract::extract;
use kynch::cli::status::{Problem, Status};
use kynch::store::Store;

fn main() -> ExitCode {
    let console = Console::from_environment();
    let ended = Command::from_arguments(Arguments::parse()).and_then(|command| perform(&console, &command));
    let status = ended.unwrap_or_else(|problem| {
        console.complain_about(&problem);
        problem.status()
    });
    status.into()
}

fn perform(console: &Console, command: &Command) -> Result<Status, Problem> {
    match command {
        Command::Study(job, reporting) => for_each(console, job, Store::open, |study, store, options| {
            let ran = run(console, &study, store, options)?;
            let judged = make_report(console, study, store, options, reporting)?;
            Ok(ran.max(judged))
        }),
        Command::Plan(job) => for_each(console, job, Store::read, |study, store, options| {
            show_plan(console, &study, store, options)
        }),
        Command::Run(job) => for_each(console, job, Store::open, |study, store, options| {
            run(console, &study, store, options)
        }),
        Command::Report(job, reporting) => for_each(console, job, Store::read, |study, store, options| {
            make_report(console, study, store, options, reporting)
        }),
        Command::Export(job, extraction) => extract(console, job, extraction),
        Command::Explain(names) => explain(console, names),
        Command::Verify(store) => verify(console, store),
        Command::List => tell(console, &kynch::cli::list(console.paint)),
        Command::Schema => tell(console, &format!("{:#}\n", kynch::study::schema())),
        Command::Completions(shell) => tell(console, &completions(*shell)),
    }
}

fn tell(console: &Console, text: &str) -> Result<Status, Problem> {
    console.say(text).map(|()| Status::Held)
}
