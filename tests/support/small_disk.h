/// A disk of a few megabytes that really fills up, for programs that are started on it.
#pragma once

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overt::test {

/// A file system in memory over a folder, seen by those processes only that enter() was called in. Needs no
/// rights: it lies in a name space of its own, which a process holds until the end.
class SmallDisk {
  public:
    SmallDisk(const std::filesystem::path& folder, std::uint64_t bytes) {
        std::filesystem::create_directories(folder);
        int requests[2], answers[2];
        if (::pipe2(requests, O_CLOEXEC) != 0 || ::pipe2(answers, O_CLOEXEC) != 0)
            return;
        holder_ = ::fork();
        if (holder_ == 0) {
            ::close(requests[1]);
            hold(folder, requests[0], answers[1]);
        }
        ::close(requests[0]);
        ::close(answers[1]);
        request_ = requests[1], answer_ = answers[0];
        is_there_ = resize(bytes);
    }
    ~SmallDisk() {
        ::close(request_);
        ::close(answer_);
        ::kill(holder_, SIGKILL);
        ::waitpid(holder_, nullptr, 0);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    /// False where the system does not allow mounting, as many containers do.
    bool is_there() const { return is_there_; }

    /// Makes room, or takes it.
    bool resize(std::uint64_t bytes) const {
        char answer = 'n';
        return ::write(request_, &bytes, sizeof bytes) == sizeof bytes && ::read(answer_, &answer, 1) == 1 &&
               answer == 'y';
    }
    /// Where a file of the disk is to be seen from outside.
    std::filesystem::path seen(const std::filesystem::path& file) const {
        return "/proc/" + std::to_string(holder_) + "/root" + file.string();
    }

    /// In a process that is to see the disk, before its program begins.
    void enter() const {
        for (const char* const space : {"user", "mnt"}) {
            const std::string name = "/proc/" + std::to_string(holder_) + "/ns/" + space;
            const int file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
            if (file < 0 || ::setns(file, 0) != 0)
                ::_exit(126);
        }
    }

  private:
    static bool write_text(const char* file, const std::string& text) {
        const int descriptor = ::open(file, O_WRONLY | O_CLOEXEC);
        const bool is_written = descriptor >= 0 && ::write(descriptor, text.data(), text.size()) ==
                                                       static_cast<::ssize_t>(text.size());
        ::close(descriptor);
        return is_written;
    }

    /// The first size mounts, the others change it.
    [[noreturn]] static void hold(const std::filesystem::path& folder, int requests, int answers) {
        const std::string user = std::to_string(::getuid()), group = std::to_string(::getgid());
        const bool is_alone = ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 &&
                              write_text("/proc/self/setgroups", "deny") &&
                              write_text("/proc/self/uid_map", "0 " + user + " 1") &&
                              write_text("/proc/self/gid_map", "0 " + group + " 1");
        unsigned long flags = 0;
        for (std::uint64_t bytes = 0; ::read(requests, &bytes, sizeof bytes) == sizeof bytes;
             flags = MS_REMOUNT) {
            const std::string size = "size=" + std::to_string(bytes);
            const bool is_done =
                is_alone && ::mount("overt_test", folder.c_str(), "tmpfs", flags, size.c_str()) == 0;
            if (::write(answers, is_done ? "y" : "n", 1) != 1)
                break;
        }
        ::_exit(0);
    }

    pid_t holder_ = -1;
    int request_ = -1, answer_ = -1;
    bool is_there_ = false;
};

} // namespace overt::test
