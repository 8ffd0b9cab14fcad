#include "experiment/record/session_directory.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/observer_label.h"
#include "experiment/record/session_schema.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

void check_names(const SessionPlace& place) {
    check_observer_label(place.observer_label);
    const std::string& name = place.protocol_name;
    const auto fits = [](char c) { return is_letter_or_digit(c) || c == '_' || c == '-' || c == '.'; };
    if (name.empty() || name.front() == '.' || !std::all_of(name.begin(), name.end(), fits))
        throw InputError(
            fmt::format("Protocol name \"{}\": use letters, digits, \"_\", \"-\" and \".\" only, and no "
                        "\".\" at the beginning; a folder is named by it.",
                        name));
}

std::string stem(const SessionPlace& place) { return fmt::format("sub-{}_ses-", place.observer_label); }

InputError taken(const fs::path& path, const SessionPlace& place) {
    return InputError(fmt::format("{}: this session exists already and is not overwritten. The next free "
                                  "session number is {}; an interrupted session goes on with --resume.",
                                  path.string(), next_session_number(place)));
}

/// The folder that must be written to if `path` is to be made.
fs::path nearest_existing(fs::path path) {
    std::error_code ignored;
    for (path = fs::absolute(path); !fs::exists(path, ignored) && path.has_relative_path();)
        path = path.parent_path();
    return path;
}

/// Hands over the folders whose names begin with this and a number, as number, rest of the name, and path.
template <class Take> void read_folders(const SessionPlace& place, const std::string& prefix, Take take) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place.root / place.protocol_name, none)) {
        const std::string name = entry.path().filename().string();
        if (!std::string_view(name).starts_with(prefix))
            continue;
        int number = 0;
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + prefix.size(), end, number);
        if (read.ec == std::errc())
            take(number, std::string_view(read.ptr, end), entry.path());
    }
}

/// Folders of this observer's sessions that are in the making, or were when their program was killed, and the
/// numbers that they will have.
std::vector<std::pair<int, fs::path>> unfinished_folders(const SessionPlace& place) {
    std::vector<std::pair<int, fs::path>> folders;
    read_folders(place, fmt::format(".{}", stem(place)),
                 [&](int number, std::string_view rest, const fs::path& path) {
                     if (rest.starts_with(".partial-"))
                         folders.emplace_back(number, path);
                 });
    return folders;
}

/// Removes what killed programs left. Throws InputError if a living one is making the number that is wanted.
void remove_remnants(const SessionPlace& place, std::optional<int> wanted) {
    for (const auto& [number, folder] : unfinished_folders(place)) {
        const FolderLock lock(folder, FolderLock::Patience::none);
        if (!lock.is_refused()) {
            std::error_code ignored;
            fs::remove_all(folder, ignored);
        } else if (number == wanted) {
            throw InputError(
                fmt::format("{}: another program is beginning this session just now. The next free "
                            "session number is {}.",
                            session_path(place, number).string(), next_session_number(place)));
        }
    }
}

/// Of this protocol, with a session that is there.
std::set<std::string> observers_alike(const SessionPlace& place) {
    constexpr std::string_view begin = "sub-", middle = "_ses-";
    std::set<std::string> labels;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place.root / place.protocol_name, none)) {
        const std::string name = entry.path().filename().string();
        const std::size_t end = name.find(middle);
        if (!name.starts_with(begin) || end == std::string::npos)
            continue;
        const std::string label = name.substr(begin.size(), end - begin.size());
        if (are_alike(label, place.observer_label))
            labels.insert(label);
    }
    return labels;
}

/// An observer who has sessions already keeps them, whoever else has come since.
void refuse_likely_same_person(const SessionPlace& place) {
    if (place.is_another_person || !session_numbers(place).empty())
        return;
    const std::set<std::string> labels = observers_alike(place);
    if (!labels.empty())
        throw InputError(fmt::format(
            "Observer {0}: {1} has sessions of observer {2}, and the two labels differ in case or leading "
            "zeros only, so that one person would be counted as two. If this is the same person, give "
            "--observer {3}; if it is not, give --another-person.",
            place.observer_label, (place.root / place.protocol_name).string(), fmt::join(labels, ", "),
            *labels.begin()));
}

} // namespace

void check_observer_label(const std::string& label) {
    constexpr std::size_t most_characters = 40;
    if (label.size() > most_characters)
        throw InputError(
            fmt::format("Observer label \"{}…\": {} characters are too many; {} is the most, for files "
                        "are named by it.",
                        label.substr(0, 12), label.size(), most_characters));
    if (label.empty() || !std::all_of(label.begin(), label.end(), is_letter_or_digit))
        throw InputError(fmt::format("Observer label \"{}\": use letters and digits only, such as 07 or P07; "
                                     "files are named by it.",
                                     label));
}

void check_session_place(const SessionPlace& place, std::optional<int> session_number) {
    if (session_number) {
        const fs::path path = session_path(place, *session_number);
        if (fs::exists(path))
            throw taken(path, place);
    }
    check_names(place);
    const fs::path folder = nearest_existing(place.root / place.protocol_name);
    if (!fs::is_directory(folder))
        throw InputError(
            fmt::format("{}: sessions cannot be put there, for it is no folder.", folder.string()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw InputError(fmt::format("{}: sessions cannot be put there: {}. Name another folder with "
                                     "--sessions, or change its permissions.",
                                     folder.string(), std::strerror(errno)));
    refuse_likely_same_person(place);
}

fs::path session_path(const SessionPlace& place, int session_number) {
    check_names(place);
    return place.root / place.protocol_name / fmt::format("{}{:02}", stem(place), session_number);
}

std::vector<int> session_numbers(const SessionPlace& place) {
    check_names(place);
    std::vector<int> numbers;
    read_folders(place, stem(place), [&](int number, std::string_view rest, const fs::path&) {
        if (rest.empty())
            numbers.push_back(number);
    });
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

int next_session_number(const SessionPlace& place) {
    int highest = 0;
    for (const int number : session_numbers(place))
        highest = std::max(highest, number);
    for (const auto& [number, folder] : unfinished_folders(place))
        if (number > highest && FolderLock(folder, FolderLock::Patience::none).is_refused())
            highest = number;
    return highest + 1;
}

fs::path further_record(const fs::path& session, const std::string& tracker_id) {
    return session / further_records_folder / tracker_id;
}

std::vector<std::string> further_trackers_of(const fs::path& session) {
    std::vector<std::string> ids;
    std::error_code none;
    if (fs::is_symlink(session / further_records_folder, none))
        return ids;
    for (const auto& entry : fs::directory_iterator(session / further_records_folder, none))
        if (!entry.is_symlink(none) && is_file_inside(entry.path(), session_file_name))
            ids.push_back(entry.path().filename().string());
    std::sort(ids.begin(), ids.end());
    return ids;
}

SessionDirectory::SessionDirectory(const SessionPlace& place, std::optional<int> session_number)
    : place_(place) {
    if (session_number && *session_number < 1)
        throw InputError(fmt::format("Session number {}: numbers count from 1.", *session_number));
    check_names(place);
    std::error_code error;
    fs::create_directories(place.root / place.protocol_name, error); // or else PartialDirectory tells why not
    // Numbers are taken one after the other.
    const FolderLock one_at_a_time(place.root / place.protocol_name,
                                   FolderLock::Patience::as_long_as_it_takes);
    remove_remnants(place, session_number);
    session_number_ = session_number ? *session_number : next_session_number(place);
    const fs::path path = session_path(place, session_number_);
    if (fs::exists(path))
        throw taken(path, place_);
    directory_.emplace(path);
    claim_ = FolderLock(directory_->path(), FolderLock::Patience::as_long_as_it_takes);
}

fs::path SessionDirectory::session_file() const { return path() / session_file_name; }

void SessionDirectory::publish() {
    if (!directory_->is_published() && fs::exists(directory_->final_path()))
        throw taken(directory_->final_path(), place_);
    directory_->publish();
    claim_ = {};
}

} // namespace overt
