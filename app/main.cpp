#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include <fmt/format.h>
#include <malloc.h>

#include "app/cli/terminal_output.h"
#include "app/command_line.h"
#include "app/inputs/protocol_file.h"
#include "experiment/base/error.h"

namespace {

/// Runs the command; its exit code.
int run(int argc, char** argv) {
    try {
        return overt::run_command_line(argc, argv);
    } catch (const overt::FindingsPrinted&) {
        return 2;
    } catch (const overt::InputError& error) {
        fmt::print(stderr, "overt: {}\n", error.what());
        return 2;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "overt: the memory of this machine does not suffice: close other programs\n");
        return 1;
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string place = error.path1().empty() ? "a file or folder" : error.path1().string();
        fmt::print(stderr,
                   "overt: {}: cannot be used ({}): see whether it is there, may be read and written by this "
                   "user, and whether its disk is full\n",
                   place, error.code().message());
        return 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "overt: {}\n", error.what());
        return 1;
    }
}

} // namespace

int main(int argc, char** argv) {
    overt::keep_output_from_failing();
    // A file that may not grow any more is then an error like a full disk, which is told and leaves what is
    // recorded in order, instead of the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    // Memory of pictures and maps goes back to the system when it is freed, instead of staying with the
    // thread that used it.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    // What is smaller is not given back and asked for again with each trial: pages that the system hands out
    // anew cost a quarter of an analysis, and a moment within a trial.
    mallopt(M_TOP_PAD, 64 << 20);
    const int exit_code = run(argc, argv);
    if (overt::all_output_arrived())
        return exit_code;
    fmt::print(stderr, "overt: standard output cannot be written: what was printed is not complete\n");
    return exit_code == 0 ? 1 : exit_code;
}
