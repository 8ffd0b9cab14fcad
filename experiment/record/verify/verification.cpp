#include "experiment/record/verify/verification.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/folder_lock.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/utf8_text.h"
#include "experiment/record/file_hash.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "experiment/record/verify/log_check.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

class SessionVerification {
  public:
    explicit SessionVerification(fs::path folder) : folder_(std::move(folder)) {}

    Verification run() {
        if (!fs::is_directory(folder_) ||
            (!fs::exists(folder_ / session_file_name) && !fs::exists(folder_ / manifest_file_name)))
            throw InputError(fmt::format("{}: there is no session here.", folder_.string()));
        if (FolderLock(folder_, FolderLock::Patience::none).is_refused())
            result_.state = Verification::State::running;
        else
            result_.state = Verification::State::interrupted; // until it is seen to be closed
        const std::optional<SessionManifest> manifest = look_at_manifest();
        look_at_log();
        look_at_session_file();
        if (cannot_open_ && manifest && manifest->is_closed && result_.state != Verification::State::running)
            result_.state = Verification::State::closed; // then its hash is known
        look_between_rows();
        if (manifest) {
            look_whose_it_is(*manifest);
            look_at_files(*manifest);
        }
        if (newer_format_ && result_.is_sound() && result_.state == Verification::State::closed)
            throw InputError(*newer_format_);
        if (cannot_open_)
            damage(session_file_name, fmt::format("cannot be opened: {}", *cannot_open_));
        make_printable();
        return std::move(result_);
    }

  private:
    void damage(std::string file, std::string what) {
        Damage damage{std::move(file), {}, {}, {}, {}, {}, std::move(what)};
        result_.damages.push_back(std::move(damage));
    }

    /// Damaged bytes are quoted in what is said of them, and need not be text.
    void make_printable() {
        const auto make_text = [](std::string& said) {
            if (!is_utf8(said))
                said = utf8_of_latin1(said);
        };
        for (Damage& damage : result_.damages)
            for (std::string* said : {&damage.file, &damage.table, &damage.row, &damage.what})
                make_text(*said);
        for (std::string& note : result_.notes)
            make_text(note);
    }

    std::optional<SessionManifest> look_at_manifest() {
        try {
            return read_manifest(folder_);
        } catch (const RecordError& error) {
            if (fs::exists(folder_ / manifest_file_name))
                damage(manifest_file_name, "is not as it was written");
            else
                is_without_manifest_ = true;
        }
        return std::nullopt;
    }

    void look_at_log() {
        // While it is written its end cannot be told from damage.
        if (result_.state == Verification::State::running)
            return;
        if (!is_file_inside(folder_, log_name_))
            return;
        const std::optional<LogFinding> found = look_through_log(folder_ / log_name_);
        if (found && found->kind == LogFinding::Kind::damaged)
            damage(log_name_, found->what);
        else if (found)
            result_.notes.push_back(fmt::format("{}: {}", log_name_, found->what));
    }

    void look_at_session_file() {
        try {
            std::error_code error;
            const auto log_bytes = fs::file_size(folder_ / log_name_, error);
            has_log_ = !error && log_bytes > 0; // now: opening the file may make an empty one
            const SQLite::Database database =
                open_session_file(folder_ / session_file_name, SessionFileUse::as_it_is);
            SQLite::Statement(database, "BEGIN").exec(); // one state of it, also while it is written
            look_at_database(database);
        } catch (const NewerFormatError& error) {
            cannot_open_ = newer_format_ = error.what();
        } catch (const Error& error) {
            cannot_open_ = error.what();
        } catch (const SQLite::Exception& error) {
            damage(session_file_name, fmt::format("cannot be read: {}", error.what()));
        }
    }

    void look_at_database(const SQLite::Database& database) {
        Query version(database, "PRAGMA user_version");
        version.step();
        const bool has_seals = version.small() >= first_version_with_seals;
        if (is_without_manifest_ && has_seals)
            damage(manifest_file_name, "is missing");
        look_at_structure(database);
        if (Query own(database, "SELECT protocol_name, observer_label, session_number FROM session");
            own.step()) {
            const std::string protocol = own.text(), observer = own.text();
            whose_ = name_of_session(protocol, observer, own.small());
        }
        bool is_closed = false;
        Query closed(database, "SELECT closed FROM sitting ORDER BY sitting DESC LIMIT 1");
        if (closed.step())
            is_closed = closed.integer() == 1;
        if (is_closed && result_.state != Verification::State::running)
            result_.state = Verification::State::closed;
        if (result_.state == Verification::State::interrupted)
            file_hash_ = noted_file_hash(database);
        if (file_hash_ && !has_log_) {
            // The hash is only ever noted in the log: it can have come into the file with the log alone.
            file_hash_.reset();
            result_.notes.emplace_back(
                "session.sqlite: another program has folded its log into it, as sqlite3 does "
                "without -readonly; the rows are looked at, bytes between them are not");
        } else {
            look_for_missing_log(database);
        }
        learn_files(database);
        if (!has_seals) {
            result_.notes.emplace_back(
                "an earlier overt recorded this session, without seals: only the structure "
                "of session.sqlite can be looked at");
            return;
        }
        SealFindings findings = check_seals(database, is_closed);
        result_.seals = findings.seals;
        if (findings.unsealed_rows > 0)
            result_.notes.push_back(fmt::format("{} rows are not sealed yet: those of the trial that was "
                                                "running, and what came after the last seal",
                                                findings.unsealed_rows));
        std::move(findings.damages.begin(), findings.damages.end(), std::back_inserter(result_.damages));
    }

    /// The file of another session is sealed as well as this one's.
    void look_whose_it_is(const SessionManifest& manifest) {
        const std::string meant =
            name_of_session(manifest.protocol, manifest.observer, manifest.session_number);
        if (!whose_ || is_damaged(session_file_name) || *whose_ == meant)
            return;
        damage(session_file_name,
               fmt::format("is that of another session: of {}, and the manifest is of {}", *whose_, meant));
    }

    static std::string name_of_session(const std::string& protocol, const std::string& observer, int number) {
        return fmt::format("{}, observer {}, session {}", protocol, observer, number);
    }

    /// Bytes of an interrupted session's file that no row is in.
    void look_between_rows() {
        if (!file_hash_ || is_damaged(session_file_name) ||
            hash_of_file(folder_ / session_file_name) == *file_hash_)
            return;
        damage(session_file_name, "is not as it was when rows were last moved into it from the log; all rows "
                                  "are as they were sealed");
    }

    bool is_damaged(const std::string& file) const {
        return std::any_of(result_.damages.begin(), result_.damages.end(),
                           [&](const Damage& other) { return other.file == file; });
    }

    /// Of what is made while the session runs: maps and spoken answers.
    void learn_files(const SQLite::Database& database) {
        for (const std::string_view table : {"map", "answer_recording"}) {
            if (!has_column(database, std::string(table).c_str(), "sha256"))
                continue;
            for (Query row(database, fmt::format("SELECT file, sha256 FROM {}", table).c_str());
                 row.step();) {
                const std::string file = row.text();
                recorded_files_[file] = row.text();
            }
        }
    }

    void look_at_structure(const SQLite::Database& database) {
        try {
            for (Query row(database, "PRAGMA integrity_check(20)"); row.step();)
                if (const std::string finding = row.text(); finding != "ok")
                    damage(session_file_name, finding);
        } catch (const SQLite::Exception& error) {
            damage(session_file_name, error.what());
        }
    }

    void look_for_missing_log(const SQLite::Database& database) {
        if (result_.state != Verification::State::interrupted || fs::exists(folder_ / log_name_))
            return;
        Query mode(database, "PRAGMA journal_mode");
        if (mode.step() && mode.text() == "wal")
            damage(log_name_,
                   "is missing: an interrupted session needs it, unless another program has folded "
                   "it into session.sqlite");
    }

    void look_at_files(const SessionManifest& manifest) {
        std::set<std::string> known;
        for (const SessionManifest::File& file : manifest.files) {
            known.insert(file.path);
            if (file.path == session_file_name && result_.state != Verification::State::closed)
                continue; // it has gone on since
            look_at_file(file);
        }
        look_for_links();
        for (const std::string& name : files_of_session(folder_, false)) {
            if (known.contains(name))
                continue;
            // What was made while the session ran has its hash in the record.
            if (const auto map = recorded_files_.find(name); map != recorded_files_.end())
                look_at_file({name, fs::file_size(folder_ / name), map->second});
            else
                result_.notes.push_back(fmt::format(
                    "{}: is not in the manifest: {}", name,
                    manifest.is_closed ? "it was added later" : "it came after the session was begun"));
        }
        if (!manifest.is_closed && result_.state == Verification::State::closed)
            result_.notes.emplace_back("the session ended in order, but its manifest was not finished: "
                                       "overt run … --resume finishes it");
    }

    /// What lies in the folder and is none of its files; nothing follows it. The socket of a session that
    /// runs is its own.
    void look_for_links() {
        std::error_code unreadable;
        for (const auto& entry : fs::recursive_directory_iterator(
                 folder_, fs::directory_options::skip_permission_denied, unreadable)) {
            const fs::file_type type = entry.symlink_status().type();
            if (type == fs::file_type::regular || type == fs::file_type::directory ||
                type == fs::file_type::socket)
                continue;
            result_.notes.push_back(fmt::format("{}: is {}, and is neither read nor copied",
                                                entry.path().lexically_relative(folder_).generic_string(),
                                                type == fs::file_type::symlink ? "a link" : "no file"));
        }
    }

    void look_at_file(const SessionManifest::File& file) {
        const fs::path path = folder_ / file.path;
        std::error_code error;
        if (const std::string why = why_no_file_inside(folder_, file.path); !why.empty())
            return damage(file.path, why);
        ++result_.files;
        result_.bytes += static_cast<std::int64_t>(fs::file_size(path, error));
        if (fs::file_size(path, error) != file.bytes)
            return damage(file.path, fmt::format("has {} bytes where {} were recorded",
                                                 fs::file_size(path, error), file.bytes));
        try {
            if (hash_of_file(path) == file.sha256)
                return;
        } catch (const InputError&) {
            return damage(file.path, "cannot be read");
        }
        damage(file.path, file.path != session_file_name ? "is not what was recorded"
                          : is_damaged(session_file_name)
                              ? "is not as it was when the session ended"
                              : "is not as it was when the session ended; all rows "
                                "are as they were sealed");
    }

    fs::path folder_;
    std::string log_name_ = std::string(session_file_name) + "-wal";
    bool is_without_manifest_ = false, has_log_ = false;
    std::optional<std::string> cannot_open_, newer_format_; ///< why the session file cannot be looked into
    std::optional<std::string> whose_;                      ///< what the session file says of itself
    std::map<std::string, std::string> recorded_files_;     ///< hash by file
    std::optional<ContentHash> file_hash_; ///< of an interrupted session's file, if it was noted
    Verification result_;
};

} // namespace

std::string_view name_of(Verification::State state) {
    constexpr std::string_view names[] = {"closed", "interrupted", "running"};
    return names[static_cast<int>(state)];
}

std::vector<std::string> broken_seals(const fs::path& session) {
    std::vector<std::string> sentences;
    const fs::path folder = session.filename() == session_file_name ? session.parent_path() : session;
    try {
        const SQLite::Database database =
            open_session_file(folder / session_file_name, SessionFileUse::as_it_is);
        SQLite::Statement(database, "BEGIN").exec(); // one state of it, also while it is written
        Query version(database, "PRAGMA user_version");
        if (!version.step() || version.small() < first_version_with_seals)
            return sentences;
        Query closed(database, "SELECT closed FROM sitting ORDER BY sitting DESC LIMIT 1");
        const bool is_closed = closed.step() && closed.integer() == 1;
        for (const Damage& damage : check_seals(database, is_closed).damages)
            sentences.push_back(to_text(damage));
    } catch (const Error&) {
    } catch (const SQLite::Exception& error) {
        sentences.push_back(fmt::format("{}: cannot be read: {}", session_file_name, error.what()));
    }
    return sentences;
}

Verification verify_session(const fs::path& folder) {
    // The session file itself may be named, as everywhere.
    const bool is_file = folder.filename() == session_file_name;
    return SessionVerification(is_file ? folder.parent_path() : folder).run();
}

} // namespace overt
