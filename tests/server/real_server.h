// The built program as a child process on a free port, for tests with hostile clients.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/paths.h"

namespace sporeprint::server {

/// A running server process; stopped by the destructor.
class RealServer {
  public:
    /// most_files  its hard limit of descriptors; 0: that of the test
    /// options     further flags
    /// log         file for its standard error, at all levels; empty: standard error of the test,
    ///             at level warning
    explicit RealServer(unsigned most_files = 0, const std::vector<std::string>& options = {},
                        std::string log = {})
        : log_(std::move(log)) {
        std::vector<const char*> arguments = {"sporeprint", "--port", "0", "--log-level",
                                              log_.empty() ? "warning" : "debug"};
        for (const std::string& option : options) arguments.push_back(option.c_str());
        arguments.push_back(nullptr);
        int out[2];
        if (::pipe(out) != 0) return;
        pid_ = ::fork();
        if (pid_ == 0) {
            if (most_files > 0) {
                const rlimit limit{most_files, most_files};
                setrlimit(RLIMIT_NOFILE, &limit);
            }
            ::dup2(out[1], STDOUT_FILENO);
            ::close(out[0]);
            ::close(out[1]);
            if (!log_.empty())
                ::dup2(::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
            ::execv(server_program(), const_cast<char* const*>(arguments.data()));
            ::_exit(127);
        }
        ::close(out[1]);
        std::string output;
        char byte = 0;
        while (output.find('\n') == std::string::npos && ::read(out[0], &byte, 1) == 1)
            output += byte;
        ::close(out[0]);
        const std::size_t colon = output.rfind(':');
        if (colon != std::string::npos) port_ = std::atoi(output.c_str() + colon + 1);
    }
    ~RealServer() { stop(); }
    RealServer(const RealServer&) = delete;
    RealServer& operator=(const RealServer&) = delete;

    int port() const { return port_; }

    bool runs() const {
        return pid_ > 0 && ::kill(pid_, 0) == 0 && ::waitpid(pid_, nullptr, WNOHANG) == 0;
    }

    /// Sends SIGTERM; returns its exit status, -1 if it was killed by a signal.
    int stop() {
        if (pid_ <= 0) return -1;
        ::kill(pid_, SIGTERM);
        return wait();
    }

    /// Waits for its end; returns its exit status, -1 if it was killed by a signal.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    /// Sends SIGHUP.
    void hang_up() const { ::kill(pid_, SIGHUP); }

    /// Returns its log so far.
    std::string log() const {
        std::ifstream in(log_);
        std::ostringstream text;
        text << in.rdbuf();
        return text.str();
    }

    /// Returns true if its log contains this text within 10 s.
    bool logs(std::string_view text) const {
        for (int i = 0; i < 1000 && log().find(text) == std::string::npos; ++i) ::usleep(10'000);
        return log().find(text) != std::string::npos;
    }

    /// Returns its resident memory in bytes.
    long resident() const {
        std::ifstream in("/proc/" + std::to_string(pid_) + "/statm");
        long total = 0, pages = 0;
        in >> total >> pages;
        return pages * ::sysconf(_SC_PAGESIZE);
    }

    std::size_t open_files() const {
        std::size_t count = 0;
        if (DIR* folder = ::opendir(("/proc/" + std::to_string(pid_) + "/fd").c_str())) {
            while (::readdir(folder)) ++count;
            ::closedir(folder);
        }
        return count;
    }

  private:
    std::string log_;
    pid_t pid_ = -1;
    int port_ = 0;
};

}  // namespace sporeprint::server
