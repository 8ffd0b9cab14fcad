#include "app/inputs/session_folders.h"

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_named = 12;

bool is_session(const fs::path& folder) {
    std::error_code unreadable;
    return fs::exists(folder / session_file_name, unreadable);
}

/// By their paths; folders that cannot be read hold none.
void find_below(const fs::path& folder, int depth, std::vector<fs::path>& found) {
    std::error_code unreadable;
    std::vector<fs::path> inside;
    for (fs::directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
         entry.increment(unreadable)) {
        std::error_code unknown;
        if (entry->is_directory(unknown) && !entry->is_symlink(unknown) &&
            !entry->path().filename().string().starts_with('.'))
            inside.push_back(entry->path());
    }
    std::ranges::sort(inside);
    for (const fs::path& path : inside) {
        if (is_session(path))
            found.push_back(path);
        else if (depth > 1)
            find_below(path, depth - 1, found);
    }
}

/// Such as "sub-01_ses-01, sub-02_ses-01 and 5 more", as they are seen from the folder.
std::string list_of_names(const std::vector<fs::path>& sessions, const fs::path& folder) {
    std::string names;
    const std::size_t named = sessions.size() <= most_named ? sessions.size() : most_named - 2;
    for (std::size_t i = 0; i < named; ++i)
        names += fmt::format("{}{}", i == 0 ? "" : ", ", sessions[i].lexically_relative(folder).string());
    if (named < sessions.size())
        names += fmt::format(" and {} more", sessions.size() - named);
    return names;
}

/// Of a folder's path without a separator at its end, so that what lies in it has a tidy one.
fs::path tidy(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

std::string nothing_in(const std::string& folders, bool is_one) {
    return fmt::format(
        "{}: {} no session. Looked for {} in {}, and in folders up to {} levels below: name the "
        "folder that `overt run` named at its end (sessions/EXPERIMENT/sub-…_ses-…), or one that "
        "holds such folders.",
        folders, is_one ? "this folder holds" : "these folders hold", session_file_name,
        is_one ? "it" : "them", deepest_sessions);
}

} // namespace

std::vector<fs::path> sessions_in(const std::vector<fs::path>& given,
                                  bool (*is_taken_as_it_is)(const fs::path&)) {
    std::vector<fs::path> sessions;
    std::set<fs::path> known;
    std::string without;
    int count_without = 0;
    const auto take = [&](const fs::path& session) {
        std::error_code unknown;
        const fs::path folder = session.filename() == session_file_name ? session.parent_path() : session;
        const fs::path place = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, unknown);
        if (known.insert(unknown ? session : place).second)
            sessions.push_back(session);
        else
            fmt::print(stderr, "{}: is given more than once, and taken once\n", session.string());
    };
    for (const fs::path& path : given) {
        std::error_code unknown;
        if (!fs::is_directory(path, unknown) || is_session(path) ||
            (is_taken_as_it_is && is_taken_as_it_is(path))) {
            take(path);
            continue;
        }
        std::vector<fs::path> found;
        find_below(tidy(path), deepest_sessions, found);
        if (found.empty()) {
            without += (without.empty() ? "" : ", ") + path.string();
            ++count_without;
            continue;
        }
        fmt::print(stderr, "{}: {}: {}\n", path.string(), counted(found.size(), "session"),
                   list_of_names(found, tidy(path)));
        for (const fs::path& session : found)
            take(session);
    }
    if (count_without > 0)
        throw InputError(nothing_in(without, count_without == 1));
    return sessions;
}

fs::path session_in(const fs::path& given) {
    const std::vector<fs::path> sessions = sessions_in({given});
    if (sessions.size() > 1)
        throw InputError(fmt::format("{}: this folder holds {}, and the command takes one: name it",
                                     given.string(), counted(sessions.size(), "session")));
    return sessions.front();
}

} // namespace overt
