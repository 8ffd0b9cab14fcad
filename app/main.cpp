#include <csignal>
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <malloc.h>

#include "app/command_line.h"
#include "app/inputs/protocol_file.h"
#include "experiment/base/error.h"

int main(int argc, char** argv) {
    // A file that may not grow any more is then an error like a full disk, which is told and leaves what is
    // recorded in order, instead of the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    // Memory of pictures and maps goes back to the system when it is freed, instead of staying with the
    // thread that used it.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    // What is said comes line by line, also through a pipe, and in order with the progress on standard error.
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    try {
        return overt::run_command_line(argc, argv);
    } catch (const overt::FindingsPrinted&) {
        return 2;
    } catch (const overt::InputError& error) {
        fmt::print(stderr, "overt: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "overt: {}\n", error.what());
        return 1;
    }
}
