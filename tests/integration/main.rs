mod bad_inputs;
mod studies;
