fn main() -> std::process::ExitCode {
    femto_cli::main()
}
