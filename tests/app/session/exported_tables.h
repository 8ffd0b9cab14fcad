/// What two sessions have in common, by their exports.
#pragma once

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiment/ports/event_kinds.h"
#include "tests/app/small_experiment.h"

namespace overt::test {

using Tables = std::map<std::string, std::string>;

/// A table without its first two columns: the observer, and the number of the session, in which the sessions
/// that are compared here differ; and without the event that names the sessions before.
inline std::string without_session(const std::string& table) {
    std::istringstream lines(table);
    std::string rest;
    for (std::string line; std::getline(lines, line);)
        if (line.find(earlier_sessions_event) == std::string::npos)
            rest += line.substr(line.find('\t', line.find('\t') + 1)) + '\n';
    return rest;
}

/// All files of an export by their names, byte for byte, less the number of the session.
inline Tables exported(const SmallExperiment& experiment, int session) {
    const std::filesystem::path folder = experiment.folder().path() / ("tables" + std::to_string(session));
    const ProgramRun run =
        experiment.overt({"export", experiment.session(session).string(), "--out", folder.string()});
    if (run.exit_code != 0)
        throw std::runtime_error(run.err);
    Tables tables;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        tables[entry.path().filename().string()] = entry.path().extension() == ".tsv"
                                                       ? without_session(text_of(entry.path()))
                                                       : text_of(entry.path());
    return tables;
}

/// Names of the files that differ; comparing the files themselves would print megabytes.
inline std::vector<std::string> differing(const Tables& a, const Tables& b) {
    std::vector<std::string> names;
    for (const auto& [name, text] : a) {
        if (!b.contains(name) || b.at(name) != text)
            names.push_back(name);
    }
    for (const auto& [name, text] : b) {
        if (!a.contains(name))
            names.push_back(name);
    }
    return names;
}

} // namespace overt::test
