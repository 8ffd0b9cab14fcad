/// The program, started and left to run.
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overt::test {

class RunningProgram {
  public:
    /// `overt ARGUMENTS`, what it says going to a file. `environment`: NAME=VALUE. `before` runs in the
    /// program's process before it begins.
    RunningProgram(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                   const std::filesystem::path& said, const std::function<void()>& before = {}) {
        std::vector<std::string> words{OVERT_PROGRAM};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        for (std::string& word : words)
            pointers.push_back(word.data());
        pointers.push_back(nullptr);
        pid_ = fork();
        if (pid_ != 0)
            return;
        for (const std::string& variable : environment)
            putenv(const_cast<char*>(variable.c_str()));
        const int file = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(file, 1);
        dup2(file, 2);
        if (before)
            before();
        execv(words.front().c_str(), pointers.data());
        _exit(127);
    }
    ~RunningProgram() {
        signal(SIGKILL);
        wait();
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    pid_t id() const { return pid_; }

    void signal(int number) const {
        if (!has_ended_)
            kill(pid_, number);
    }
    /// Until its end; its exit code, or 128 and the number of the signal that killed it.
    int wait() {
        if (!has_ended_)
            waitpid(pid_, &status_, 0);
        has_ended_ = true;
        return code();
    }
    bool is_running() {
        if (!has_ended_)
            has_ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
        return !has_ended_;
    }

  private:
    int code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_); }

    pid_t pid_ = -1;
    int status_ = 0;
    bool has_ended_ = false;
};

} // namespace overt::test
