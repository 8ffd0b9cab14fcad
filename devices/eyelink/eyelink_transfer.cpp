/// The end of a session with an EyeLink: its files come from the host into the session's folder.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "devices/eyelink/eyelink_driver.h"
#include "devices/eyelink/eyelink_words.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

/// The library's report of a transfer is told nothing of whom it works for.
const EyeTracker::FileProgress* active_progress = nullptr;

/// Where a file of the host goes: a place at which there is none yet, so that nothing is ever replaced.
std::filesystem::path free_place(const std::filesystem::path& folder, const std::string& name) {
    std::filesystem::path file = folder / (name + ".edf");
    for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(file)); ++number)
        file = folder / fmt::format("{}-{}.edf", name, number);
    return file;
}

extern "C" void overt_el_progress(unsigned size, unsigned received) {
    try {
        if (active_progress && *active_progress)
            (*active_progress)(received, size);
    } catch (...) { // what cannot be shown must not break the transfer off
    }
}

} // namespace

void EyelinkDriver::note_left(const std::string& name, const std::filesystem::path& folder,
                              std::vector<std::string>& said) noexcept {
    if (settings_.notes.empty())
        return;
    try {
        note_left_on_host(settings_.notes, {name, settings_.address, std::filesystem::absolute(folder)});
        said.emplace_back("It is offered again: overt tracker fetch brings it once the host can be reached.");
    } catch (const std::exception& error) {
        said.emplace_back(error.what());
    }
}

void EyelinkDriver::forget_left(const std::string& name, const std::filesystem::path& folder,
                                std::vector<std::string>& said) noexcept {
    if (settings_.notes.empty())
        return;
    try {
        forget_left_on_host(settings_.notes, {name, settings_.address, std::filesystem::absolute(folder)});
    } catch (const std::exception& error) {
        said.emplace_back(error.what());
    }
}

std::vector<LeftOnHost> EyelinkDriver::left_files() const {
    std::vector<LeftOnHost> left;
    if (!settings_.notes.empty() && !settings_.is_dummy)
        left = read_left_on_host(settings_.notes);
    // Those of this session are noted, too, while they are written.
    const auto is_own = [this](const LeftOnHost& each) {
        return !folder_.empty() && each.folder == std::filesystem::absolute(folder_) &&
               std::ranges::find(files_, each.name) != files_.end();
    };
    std::erase_if(left,
                  [&](const LeftOnHost& each) { return each.host != settings_.address || is_own(each); });
    return left;
}

void EyelinkDriver::belongs_in(const std::string& folder) noexcept {
    if (settings_.is_dummy)
        return;
    try {
        folder_ = folder;
        std::vector<std::string> untold;
        for (const std::string& name : files_)
            note_left(name, folder_, untold);
    } catch (const std::bad_alloc&) { // then there is no word of it, and finish() fetches it nevertheless
    }
}

std::vector<std::string> EyelinkDriver::fetch_left_files(const EyeTracker::FileProgress& progress) {
    std::vector<std::string> said;
    const std::vector<LeftOnHost> left = left_files();
    if (left.empty())
        return said;
    close();
    open_connection();
    library_->set_offline_mode();
    clock_->wait_until(clock_->now() + 500ms);
    for (const LeftOnHost& each : left)
        if (fetch(each.name, each.folder, progress, said))
            forget_left_on_host(settings_.notes, each);
    close();
    return said;
}

bool EyelinkDriver::fetch(const std::string& name, const std::filesystem::path& folder,
                          const EyeTracker::FileProgress& progress, std::vector<std::string>& said) {
    std::string from = name + ".EDF";
    const std::filesystem::path file = free_place(folder, name),
                                part = std::filesystem::path(file) += ".part";
    std::string to = part.string();
    active_progress = &progress;
    const std::int32_t result =
        library_->receive_data_file_feedback
            ? library_->receive_data_file_feedback(from.data(), to.data(), 0, overt_el_progress)
            : library_->receive_data_file(from.data(), to.data(), 0);
    active_progress = nullptr;
    std::optional<std::string> problem = eyelink_transfer_problem(result);
    std::error_code none;
    const auto size = std::filesystem::file_size(part, none);
    if (!problem && (none || size != static_cast<std::uintmax_t>(result)))
        problem = none ? "it is not there afterwards"
                       : fmt::format("{} bytes are there and {} were sent", size, result);
    if (!problem) {
        std::filesystem::rename(part, file, none);
        if (none)
            problem = none.message();
    }
    if (problem) {
        said.push_back(
            fmt::format("The EyeLink's file {} could not be fetched: {}. It is on the host, where it can be "
                        "copied from; what arrived is in {}.",
                        from, *problem, to));
        note_left(name, folder, said);
        return false;
    }
    said.push_back(fmt::format("The EyeLink's file {}, {} bytes", file.string(), size));
    return true;
}

std::vector<std::string> EyelinkDriver::finish(const std::string& folder,
                                               const EyeTracker::FileProgress& progress) {
    std::vector<std::string> said;
    if (settings_.is_dummy || files_.empty()) {
        close();
        return said;
    }
    belongs_in(folder);
    stop();
    try {
        if (library_->eyelink_is_connected() != 1) {
            close();
            open_connection(); // the host has kept the file
        }
        library_->set_offline_mode();
        clock_->wait_until(clock_->now() + 500ms);
        if (is_file_open_)
            library_->close_data_file();
        is_file_open_ = false;
        while (!files_.empty()) {
            const std::string name = files_.front();
            if (fetch(name, folder, progress, said))
                forget_left(name, folder, said);
            files_.erase(files_.begin());
        }
    } catch (const std::exception& error) {
        said.push_back(fmt::format("The EyeLink's recording stays on its host, as {}.EDF: {}",
                                   fmt::join(files_, ".EDF, "), error.what()));
        for (const std::string& name : files_)
            note_left(name, folder, said);
    }
    close();
    files_.clear();
    folder_.clear();
    return said;
}

} // namespace overt
