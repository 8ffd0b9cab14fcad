/// The sessions that a command is given: their own folders, or folders that hold them.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace overt {

/// How deep sessions may lie in a folder that is none itself: a folder of all experiments holds one for each,
/// and that one its sessions.
inline constexpr int deepest_sessions = 3;

/// What the help of a command says of the sessions that it takes.
inline constexpr const char* sessions_help =
    "Folders of sessions, or folders that hold some, up to three levels below";

/// Each session's folder once, in the order given, those of one folder by their names: what is found in a
/// folder that is no session itself is told to standard error. A path at which nothing lies, a file and
/// whatever `is_taken_as_it_is` says stay as they are: who reads them says what is wrong with them. Hidden
/// folders, links to folders and the inside of sessions are not looked into. Throws InputError for all
/// folders together that hold none, saying what was looked for.
std::vector<std::filesystem::path>
sessions_in(const std::vector<std::filesystem::path>& given,
            bool (*is_taken_as_it_is)(const std::filesystem::path&) = nullptr);

/// The same for a command that takes one session. Throws InputError that names them if there are several.
std::filesystem::path session_in(const std::filesystem::path& given);

} // namespace overt
