//! `femto-fuel MODULE [ARGUMENT ...]`: runs a WASI program that brackets steps by calls of `count_begin` and `count_end`, as
//! `cost` of examples/cases does, and ends the program's line at each with how many instructions the interpreter took between them.

use std::error::Error;
use std::io::{Write, stdout};
use std::process::ExitCode;

use wasmi::{
    Caller, CompilationMode, Config, Engine, Error as Trap, Extern, Linker, Memory, Module, Store,
};

fn main() -> ExitCode {
    match run(std::env::args().skip(1).collect()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("femto-fuel: {error}");
            ExitCode::from(2)
        }
    }
}

/// What the program is given, and the fuel that was left at `count_begin`.
struct Host {
    arguments: Vec<String>,
    begin: u64,
}

fn run(arguments: Vec<String>) -> Result<ExitCode, Box<dyn Error>> {
    let path = arguments.first().ok_or("no module is given")?;
    let mut config = Config::default();
    config.consume_fuel(true);
    // Else the first call of a function pays for its translation.
    config.compilation_mode(CompilationMode::Eager);
    let engine = Engine::new(&config);
    let module = Module::new(&engine, std::fs::read(path)?)?;
    let mut store = Store::new(
        &engine,
        Host {
            arguments,
            begin: 0,
        },
    );
    store.set_fuel(u64::MAX)?;
    let instance = linker(&engine)?.instantiate_and_start(&mut store, &module)?;
    let start = instance.get_typed_func::<(), ()>(&store, "_start")?;
    match start.call(&mut store, ()) {
        Ok(()) => Ok(ExitCode::SUCCESS),
        Err(trap) => match trap.i32_exit_status() {
            Some(code) => Ok(ExitCode::from(u8::try_from(code)?)),
            None => Err(trap.into()),
        },
    }
}

/// The counter, and the little of WASI that a program needs which reads its arguments and prints.
fn linker(engine: &Engine) -> Result<Linker<Host>, Box<dyn Error>> {
    const WASI: &str = "wasi_snapshot_preview1";
    let mut linker = Linker::new(engine);
    linker.func_wrap("count", "count_begin", |mut host: Caller<'_, Host>| {
        host.data_mut().begin = host.get_fuel()?;
        Ok::<_, Trap>(())
    })?;
    linker.func_wrap("count", "count_end", |host: Caller<'_, Host>| {
        println!("{}", host.data().begin - host.get_fuel()?);
        Ok::<_, Trap>(())
    })?;
    linker.func_wrap(WASI, "args_sizes_get", arguments_size)?;
    linker.func_wrap(WASI, "args_get", write_arguments)?;
    linker.func_wrap(
        WASI,
        "environ_sizes_get",
        |mut host: Caller<'_, Host>, count, size| {
            write(&mut host, count, &[0; 4])?;
            write(&mut host, size, &[0; 4])
        },
    )?;
    linker.func_wrap(WASI, "environ_get", |_: i32, _: i32| 0)?;
    linker.func_wrap(WASI, "fd_write", print)?;
    linker.func_wrap(WASI, "proc_exit", |code: i32| {
        Err::<(), _>(Trap::i32_exit(code))
    })?;
    Ok(linker)
}

fn memory(host: &Caller<'_, Host>) -> Result<Memory, Trap> {
    let memory = host.get_export("memory").and_then(Extern::into_memory);
    memory.ok_or_else(|| Trap::new("the program has no memory"))
}

/// Returns WASI's code for success.
fn write(host: &mut Caller<'_, Host>, at: i32, bytes: &[u8]) -> Result<i32, Trap> {
    memory(host)?.write(host, at as usize, bytes)?;
    Ok(0)
}

fn read_number(host: &Caller<'_, Host>, at: usize) -> Result<u32, Trap> {
    let mut bytes = [0; 4];
    memory(host)?.read(host, at, &mut bytes)?;
    Ok(u32::from_le_bytes(bytes))
}

fn arguments_size(mut host: Caller<'_, Host>, count: i32, size: i32) -> Result<i32, Trap> {
    let arguments = &host.data().arguments;
    let bytes: usize = arguments.iter().map(|argument| argument.len() + 1).sum();
    let (arguments, bytes) = (arguments.len() as u32, bytes as u32);
    write(&mut host, count, &arguments.to_le_bytes())?;
    write(&mut host, size, &bytes.to_le_bytes())
}

fn write_arguments(mut host: Caller<'_, Host>, places: i32, bytes: i32) -> Result<i32, Trap> {
    let (mut place, mut at) = (places, bytes);
    for argument in host.data().arguments.clone() {
        write(&mut host, place, &at.to_le_bytes())?;
        write(&mut host, at, argument.as_bytes())?;
        at += argument.len() as i32;
        write(&mut host, at, &[0])?;
        (place, at) = (place + 4, at + 1);
    }
    Ok(0)
}

/// `fd_write`, to standard output whatever the file.
fn print(
    mut host: Caller<'_, Host>,
    _: i32,
    pieces: i32,
    count: i32,
    written: i32,
) -> Result<i32, Trap> {
    let mut total = 0;
    for piece in 0..count as usize {
        let piece = pieces as usize + 8 * piece;
        let (at, length) = (read_number(&host, piece)?, read_number(&host, piece + 4)?);
        let mut bytes = vec![0; length as usize];
        memory(&host)?.read(&host, at as usize, &mut bytes)?;
        stdout()
            .write_all(&bytes)
            .map_err(|error| Trap::new(error.to_string()))?;
        total += length;
    }
    write(&mut host, written, &total.to_le_bytes())
}
