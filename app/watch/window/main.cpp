/// The program behind `overt watch` without --terminal: overt-watch-window SOCKET [TIMES].
#include <exception>

#include <fmt/format.h>

#include "app/watch/window/watch_window.h"
#include "experiment/base/error.h"

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        fmt::print(stderr, "overt-watch-window SOCKET [TIMES]: use overt watch, which begins it\n");
        return 2;
    }
    try {
        return overt::watch_in_window(argv[1], argc > 2 ? argv[2] : "");
    } catch (const overt::InputError& error) {
        fmt::print(stderr, "overt watch: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "overt watch: {}\n", error.what());
        return 1;
    }
}
