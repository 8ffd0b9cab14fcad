/// Where a session's files lie: <root>/<protocol name>/sub-<label>_ses-<NN>.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/folder_lock.h"
#include "experiment/base/partial_directory.h"

namespace overt {

/// Whose session of what.
struct SessionPlace {
    std::filesystem::path root; ///< folder of all sessions; made if it is not there
    std::string protocol_name;  ///< letters, digits, "_", "-" and ".", not beginning with "."
    std::string observer_label; ///< letters and digits only, as BIDS wants it
    /// Not the one whose label differs from this in case or leading zeros only.
    bool is_another_person = false;
};

/// Directory of one session, whether or not it exists. Throws InputError if a name cannot be a directory's.
std::filesystem::path session_path(const SessionPlace& place, int session_number);

/// Throws InputError for a label that no file can be named by: letters and digits only, as BIDS wants it.
void check_observer_label(const std::string& label);

/// Finds out whether a session can be put there, without making anything. Throws InputError if a name cannot
/// be a directory's, if a number is asked for that exists, if nothing can be written there, or if the
/// protocol has sessions of an observer whose label differs in case or leading zeros only (observer_label.h),
/// who is not said to be another person.
void check_session_place(const SessionPlace& place, std::optional<int> session_number);

/// One more than the highest number that this observer has in this protocol, from 1; sessions that other
/// programs are just making count.
int next_session_number(const SessionPlace& place);

/// Numbers of the sessions that this observer has in this protocol, ascending.
std::vector<int> session_numbers(const SessionPlace& place);

/// Where the record of a further tracker lies in a session's directory.
std::filesystem::path further_record(const std::filesystem::path& session, const std::string& tracker_id);

/// Ids of the further trackers that have a record in a session's directory, in the order of their names.
std::vector<std::string> further_trackers_of(const std::filesystem::path& session);

/// A session's directory in the making: hidden under another name until publish(), so that a directory with a
/// session's name always is a whole one. Without publish() it removes itself; what a killed program left of
/// one is removed by the next that makes one for this observer. The number is taken from the beginning on:
/// of two programs that make sessions at once, each has its own.
class SessionDirectory {
  public:
    /// Takes the next free number if none is asked for. Throws InputError if a number is asked for that
    /// exists, or that another program is making (naming the next free one), RecordError if the directory
    /// cannot be made.
    explicit SessionDirectory(const SessionPlace& place, std::optional<int> session_number = std::nullopt);

    /// Where its files are to be put; after publish() where they are.
    const std::filesystem::path& path() const { return directory_->path(); }
    /// path() / "session.sqlite"
    std::filesystem::path session_file() const;
    int session_number() const { return session_number_; }

    /// Brings all files to the disk and gives the directory its name in one step. No file in it may be open.
    /// Throws RecordError, and InputError if somebody else has taken the name meanwhile.
    void publish();

    /// Removes what was not published; nothing otherwise.
    void abandon() noexcept { directory_->abandon(); }

  private:
    SessionPlace place_;
    int session_number_ = 1;
    std::optional<PartialDirectory> directory_;
    FolderLock claim_; ///< on what is being made, for others to see
};

} // namespace overt
