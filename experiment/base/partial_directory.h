/// A directory that appears whole or not at all.
#pragma once

#include <filesystem>

namespace overt {

/// Lies hidden beside its final place, under another name, until publish(). Without publish() it removes
/// itself. A program that is killed leaves a hidden directory ".NAME.partial-…" (hidden_name.h) that no other
/// program reads, and that the next one to make something of this name removes.
class PartialDirectory {
  public:
    /// Makes the folders around it, too. Throws RecordError.
    explicit PartialDirectory(const std::filesystem::path& final_path);
    ~PartialDirectory() { abandon(); }
    PartialDirectory(const PartialDirectory&) = delete;
    PartialDirectory& operator=(const PartialDirectory&) = delete;

    /// Where its files are to be put; after publish() where they are.
    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& final_path() const { return final_path_; }
    bool is_published() const { return path_ == final_path_; }

    /// Brings all its files to the disk and gives it its name in one step. No file in it may be open, and
    /// nothing may have its name. Throws RecordError.
    void publish();

    /// The same, but gives false if somebody else has made something of its name, and leaves both as they
    /// are.
    bool publish_if_free();

    /// Removes what was not published; nothing otherwise.
    void abandon() noexcept;

  private:
    std::filesystem::path final_path_;
    std::filesystem::path path_;
};

} // namespace overt
