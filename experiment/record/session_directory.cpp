#include "experiment/record/session_directory.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "experiment/error.h"
#include "experiment/record/session_schema.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

void check_names(const SessionPlace& place) {
    const std::string& label = place.observer_label;
    if (label.empty() || !std::all_of(label.begin(), label.end(), is_letter_or_digit))
        throw InputError(fmt::format("Observer label «{}»: use letters and digits only, such as 07 or AB; "
                                     "files are named by it.",
                                     label));
    const std::string& name = place.protocol_name;
    const auto fits = [](char c) { return is_letter_or_digit(c) || c == '_' || c == '-' || c == '.'; };
    if (name.empty() || name.front() == '.' || !std::all_of(name.begin(), name.end(), fits))
        throw InputError(fmt::format("Protocol name «{}»: use letters, digits, «_», «-» and «.» only, and no "
                                     "«.» at the beginning; a folder is named by it.",
                                     name));
}

std::string stem(const SessionPlace& place) { return fmt::format("sub-{}_ses-", place.observer_label); }

InputError taken(const fs::path& path, const SessionPlace& place) {
    return InputError(fmt::format("{}: this session exists already and is not overwritten. The next free "
                                  "session number is {}; an interrupted session goes on with --resume.",
                                  path.string(), next_session_number(place)));
}

/// Brings a whole file system's writes to the disk: the session's files may have come from anywhere.
void sync_around(const fs::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && ::syncfs(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0)
        ::close(descriptor);
    if (!synced)
        throw RecordError(fmt::format("{}: writing to disk failed: {}. Check its space.", directory.string(),
                                      std::strerror(reason)));
}

} // namespace

fs::path session_path(const SessionPlace& place, int session_number) {
    check_names(place);
    return place.root / place.protocol_name / fmt::format("{}{:02}", stem(place), session_number);
}

int next_session_number(const SessionPlace& place) {
    check_names(place);
    const std::string prefix = stem(place);
    int highest = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place.root / place.protocol_name, none)) {
        const std::string name = entry.path().filename().string();
        if (!std::string_view(name).starts_with(prefix))
            continue;
        int number = 0;
        const char* const end = name.data() + name.size();
        if (const auto read = std::from_chars(name.data() + prefix.size(), end, number);
            read.ec == std::errc() && read.ptr == end)
            highest = std::max(highest, number);
    }
    return highest + 1;
}

SessionDirectory::SessionDirectory(const SessionPlace& place, std::optional<int> session_number)
    : place_(place), session_number_(session_number ? *session_number : next_session_number(place)),
      final_path_(session_path(place, session_number_)) {
    if (session_number_ < 1)
        throw InputError(fmt::format("Session number {}: numbers count from 1.", session_number_));
    if (fs::exists(final_path_))
        throw taken(final_path_, place_);
    std::error_code error;
    fs::create_directories(final_path_.parent_path(), error);
    std::string name =
        (final_path_.parent_path() / fmt::format(".{}.partial-XXXXXX", final_path_.filename().string()))
            .string();
    // A name of its own each time, so that what a killed start has left behind is in nobody's way.
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw RecordError(fmt::format("{}: a directory cannot be made there: {}. Check the permissions.",
                                      final_path_.parent_path().string(),
                                      error ? error.message() : std::strerror(errno)));
    path_ = name;
    // mkdtemp lets in its owner alone; the others get what the folder around it gives them.
    fs::permissions(path_, fs::status(final_path_.parent_path()).permissions(), error);
}

fs::path SessionDirectory::session_file() const { return path_ / session_file_name; }

void SessionDirectory::publish() {
    if (path_ == final_path_)
        return;
    sync_around(path_);
    if (fs::exists(final_path_))
        throw taken(final_path_, place_);
    std::error_code error;
    fs::rename(path_, final_path_, error);
    if (error)
        throw RecordError(fmt::format("{}: cannot be renamed to {}: {}. Check the permissions.",
                                      path_.string(), final_path_.filename().string(), error.message()));
    path_ = final_path_;
    sync_around(path_.parent_path());
}

void SessionDirectory::abandon() noexcept {
    if (path_.empty() || path_ == final_path_)
        return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    path_.clear();
}

} // namespace overt
