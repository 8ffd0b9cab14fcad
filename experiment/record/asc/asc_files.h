/// The files of an EyeLink recording in its text form.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "experiment/record/asc/asc_parser.h"

namespace overt {

/// One file, or two of one recording: its samples and its events, as edf2asc -s and -e write them.
class AscFiles {
  public:
    AscFiles(std::filesystem::path file) : events_(std::move(file)) {}
    /// In either order. Throws InputError if not one of them has samples and the other none, or if one cannot
    /// be read.
    AscFiles(const std::filesystem::path& one, const std::filesystem::path& other);

    bool are_two() const { return !samples_.empty(); }
    /// Of both, with an "and" between them.
    std::string path() const;
    /// The same without folders.
    std::string name() const;
    /// SHA-256 of each, the events first.
    std::string hashes() const;
    /// The file that a line comes from.
    const std::filesystem::path& of_line(std::string_view line) const;

    /// Gives each line of one file after the other. Throws InputError if they cannot be read, or are no text
    /// in ASCII, Latin-1 or UTF-8 with lines that end with a line feed.
    void read_lines(const std::function<void(std::string_view line)>& take,
                    const std::function<void(std::int64_t done, std::int64_t all)>& progress = {}) const;

    /// Reads and gives each line to the parser, then its end; `progress` is told the bytes read and all. Of
    /// two files the samples stand between the other's lines by their times, and what the file of samples has
    /// besides is left out, for the other has it, too. Memory does not grow with the files. Throws InputError
    /// if they cannot be read, or what the listener throws.
    void parse(AscParser& parser,
               const std::function<void(std::int64_t done, std::int64_t all)>& progress = {}) const;

  private:
    std::filesystem::path events_;  ///< the one file, or the one without samples
    std::filesystem::path samples_; ///< empty: they are in the other
};

} // namespace overt
