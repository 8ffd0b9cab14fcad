#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "app/command_line.h"
#include "app/protocol_file.h"
#include "experiment/error.h"

int main(int argc, char** argv) {
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
