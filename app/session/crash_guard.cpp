#include "app/session/crash_guard.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <memory>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

#include "app/cli/own_folders.h"
#include "app/rig/display_box_session.h"
#include "devices/eyelink/left_on_host.h"
#include "devices/link/shared_library.h"
#include "experiment/base/error.h"
#include "experiment/record/manifest.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/write/crashed_sitting.h"

namespace overt {
namespace {

constexpr std::array<int, 5> crashes{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

/// Of the stack, in which the addresses of callers lie.
constexpr std::size_t noted_stack_bytes = std::size_t{64} << 10;

/// The note begins with this; then come the stack's words, as many as `stack_bytes`, and the maps.
struct NoteHead {
    std::int64_t signal = 0;
    std::uint64_t instruction = 0, stack_bytes = 0;
};

/// All that the handler reads was made before.
struct Prepared {
    int note = -1;
    std::vector<std::string> words;
    std::vector<char*> argv;
    std::array<struct sigaction, crashes.size()> before{};
    std::vector<std::byte> stack; ///< for the handler itself: the fault may be that there is no more stack
};
Prepared* prepared = nullptr;
std::atomic_flag has_begun = ATOMIC_FLAG_INIT;

void write_all(int file, const void* bytes, std::size_t count) noexcept {
    const char* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(file, at, count);
        if (written <= 0)
            return;
        at += written;
        count -= static_cast<std::size_t>(written);
    }
}

/// On whichever thread crashed. Only calls of the system that are safe in a handler.
void on_crash(int signal, siginfo_t*, void* context) {
    while (has_begun.test_and_set())
        pause(); // another thread is at it, and takes this one along
    NoteHead head{signal, 0, 0};
    std::uint64_t stack = 0;
    const auto* const machine = &static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    head.instruction = static_cast<std::uint64_t>(machine->gregs[REG_RIP]);
    stack = static_cast<std::uint64_t>(machine->gregs[REG_RSP]);
#elif defined(__aarch64__)
    head.instruction = machine->pc;
    stack = machine->sp;
#else
    static_cast<void>(machine);
#endif
    const int note = prepared->note;
    lseek(note, sizeof(head), SEEK_SET);
    // The system stops where the stack ends.
    if (const ssize_t noted = write(note, reinterpret_cast<const void*>(stack), noted_stack_bytes); noted > 0)
        head.stack_bytes = static_cast<std::uint64_t>(noted);
    if (const int maps = open("/proc/self/maps", O_RDONLY | O_CLOEXEC); maps >= 0) {
        static std::array<char, 4096> piece;
        for (ssize_t got = 0; (got = read(maps, piece.data(), piece.size())) > 0;)
            write_all(note, piece.data(), static_cast<std::size_t>(got));
    }
    lseek(note, 0, SEEK_SET);
    write_all(note, &head, sizeof(head));
    execve("/proc/self/exe", prepared->argv.data(), environ);
    // There is no other program: the crash is what it would have been.
    struct sigaction standard {};
    standard.sa_handler = SIG_DFL;
    sigaction(signal, &standard, nullptr);
    raise(signal);
}

const char* name_of_signal(int signal) {
    switch (signal) {
    case SIGSEGV:
        return "a segmentation fault";
    case SIGBUS:
        return "a bus error";
    case SIGILL:
        return "an instruction that there is not";
    case SIGFPE:
        return "an arithmetic exception";
    case SIGABRT:
        return "an abort";
    default:
        return "a fault";
    }
}

struct CrashNote {
    int signal = SIGSEGV;
    std::vector<std::uint64_t> addresses;
    std::string maps;
};

CrashNote read_note(int file) {
    CrashNote note;
    std::string bytes;
    std::array<char, 4096> piece{};
    lseek(file, 0, SEEK_SET);
    for (ssize_t got = 0; (got = read(file, piece.data(), piece.size())) > 0;)
        bytes.append(piece.data(), static_cast<std::size_t>(got));
    NoteHead head;
    if (bytes.size() < sizeof(head))
        return note;
    std::memcpy(&head, bytes.data(), sizeof(head));
    note.signal = static_cast<int>(head.signal);
    note.addresses.push_back(head.instruction);
    const std::size_t end = std::min<std::size_t>(bytes.size(), sizeof(head) + head.stack_bytes);
    for (std::size_t at = sizeof(head); at + sizeof(std::uint64_t) <= end; at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof(word));
        note.addresses.push_back(word);
    }
    note.maps = bytes.substr(end);
    return note;
}

/// Where code lies, and of which file it is.
struct CodeRange {
    std::uint64_t begin = 0, end = 0;
    std::string file;
};

std::vector<CodeRange> code_in(const std::string& maps) {
    std::vector<CodeRange> ranges;
    std::istringstream lines(maps);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string range, rights, offset, device, inode, file;
        words >> range >> rights >> offset >> device >> inode;
        std::getline(words >> std::ws, file);
        const std::size_t dash = range.find('-');
        if (dash == std::string::npos || rights.find('x') == std::string::npos || file.empty())
            continue;
        CodeRange code{0, 0, file};
        std::from_chars(range.data(), range.data() + dash, code.begin, 16);
        std::from_chars(range.data() + dash + 1, range.data() + range.size(), code.end, 16);
        ranges.push_back(std::move(code));
    }
    return ranges;
}

/// As far as it can be, whatever of it fails. False if the session's own was closed already.
bool close_records(const std::filesystem::path& session, const std::string& what) {
    std::vector<std::filesystem::path> records;
    for (const std::string& id : further_trackers_of(session))
        records.push_back(further_record(session, id));
    records.push_back(session);
    bool was_open = false;
    for (const std::filesystem::path& record : records)
        try {
            was_open = close_crashed_sitting(record / session_file_name, what);
            if (was_open)
                static_cast<void>(close_manifest(record));
        } catch (const std::exception& error) {
            fmt::print(stderr, "overt: {}\n", error.what());
        }
    return was_open;
}

/// Of the eye tracker's files that were on their way into the session's folder.
void tell_of_files_on_the_host(const std::filesystem::path& session) {
    try {
        for (const LeftOnHost& left : read_left_on_host(state_folder()))
            if (left.folder == session)
                fmt::print(stderr,
                           "The EyeLink's file {}.EDF is on its host; overt tracker fetch brings it.\n",
                           left.name);
    } catch (const std::exception& error) {
        fmt::print(stderr, "overt: {}\n", error.what());
    }
}

} // namespace

CrashGuard::CrashGuard(const std::filesystem::path& session) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    static_cast<void>(session);
#else
    auto made = std::make_unique<Prepared>();
    made->note = memfd_create("overt crash note", 0); // the program after the crash reads it
    if (made->note < 0)
        return;
    made->words = {"overt", close_crashed_word, std::filesystem::absolute(session).string(),
                   std::to_string(made->note)};
    for (const std::string& library : loaded_vendor_libraries())
        made->words.push_back(library);
    for (std::string& word : made->words)
        made->argv.push_back(word.data());
    made->argv.push_back(nullptr);
    made->stack.resize(static_cast<std::size_t>(SIGSTKSZ) + (std::size_t{16} << 10));
    const stack_t own{made->stack.data(), 0, made->stack.size()};
    sigaltstack(&own, nullptr);
    prepared = made.release();
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigfillset(&action.sa_mask);
    for (std::size_t i = 0; i < crashes.size(); ++i)
        sigaction(crashes[i], &action, &prepared->before[i]);
#endif
}

CrashGuard::~CrashGuard() {
    if (!prepared)
        return;
    for (std::size_t i = 0; i < crashes.size(); ++i)
        sigaction(crashes[i], &prepared->before[i], nullptr);
    const stack_t none{nullptr, SS_DISABLE, 0};
    sigaltstack(&none, nullptr);
    close(prepared->note);
    delete prepared;
    prepared = nullptr;
}

std::string library_at_work(const std::string& maps, const std::vector<std::uint64_t>& addresses,
                            const std::vector<std::string>& libraries) {
    const std::vector<CodeRange> code = code_in(maps);
    const auto file_at = [&](std::uint64_t address) {
        const auto found = std::ranges::find_if(
            code, [&](const CodeRange& range) { return address >= range.begin && address < range.end; });
        return found == code.end() ? std::string() : found->file;
    };
    for (const std::uint64_t address : addresses)
        if (const std::string file = file_at(address);
            !file.empty() && std::ranges::find(libraries, file) != libraries.end())
            return file;
    return addresses.empty() ? std::string() : file_at(addresses.front());
}

int close_crashed_session(const std::vector<std::string>& given) {
    constexpr std::size_t first_library = 3;
    int note_file = -1;
    if (given.size() < first_library)
        return 2;
    std::from_chars(given[2].data(), given[2].data() + given[2].size(), note_file);
    // The handler's mask, and the priority of the thread that crashed, are still this process's.
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_UNBLOCK, &all, nullptr);
    const sched_param usual{};
    sched_setscheduler(0, SCHED_OTHER, &usual);
    const CrashNote note = read_note(note_file);
    const std::string library =
        library_at_work(note.maps, note.addresses, {given.begin() + first_library, given.end()});
    const bool is_vendors = std::find(given.begin() + first_library, given.end(), library) != given.end();
    const std::string what =
        fmt::format("{} in {}", name_of_signal(note.signal),
                    library.empty() ? std::string("code that is of no file")
                                    : (is_vendors ? "the vendor's library " : "") +
                                          std::filesystem::path(library).filename().string());
    fmt::print(stderr, "\novert: the program crashed: {}{}.\n", what,
               is_vendors ? fmt::format(" ({}): tell its maker, with the library's version", library) : "");
    if (close_records(given[1], what))
        fmt::print(stderr,
                   "The record is closed with all that had been recorded: {}\novert run … --resume goes on "
                   "with it. What an eye tracker's host has recorded is still there, under the name that the "
                   "record has.\n",
                   given[1]);
    else
        fmt::print(stderr, "The record had been closed before, and is whole: {}\n", given[1]);
    tell_of_files_on_the_host(given[1]);
    switch_back_what_was_left();
    std::fflush(nullptr);
    // As a crash ends, but without the memory of a program that is another by now.
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    std::signal(note.signal, SIG_DFL);
    raise(note.signal);
    return 128 + note.signal;
}

} // namespace overt
