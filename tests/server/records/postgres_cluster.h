// A PostgreSQL of one test program: its files are in a temporary folder, its socket is a file in it, and it ends with
// the program, however that ends.
#pragma once

#include <grp.h>
#include <libpq-fe.h>
#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/server/records/contract.h"

namespace sporeprint::server::test {

class PostgresCluster {
  public:
    /// Returns whether PostgreSQL is installed, with the user as whom it runs where the tests run as root.
    [[nodiscard]] static bool is_installed() {
        return !programs().empty() && (geteuid() != 0 || getpwnam("postgres"));
    }

    /// Returns the one of this program, which is started by the first call.
    static PostgresCluster& instance() {
        static PostgresCluster cluster;
        return cluster;
    }

    PostgresCluster() {
        if (const passwd* const user = account()) {
            const std::filesystem::path path = folder_ / "";
            if (chown(path.c_str(), user->pw_uid, user->pw_gid) != 0)
                throw std::runtime_error("the folder of PostgreSQL cannot be given to its user");
        }
        finish(spawn({"initdb", "--pgdata=" + data(), "--username=sporeprint", "--auth=trust",
                      "--encoding=UTF8", "--locale=C.UTF-8", "--no-sync"}));
        start();
    }
    ~PostgresCluster() { stop(SIGINT); }
    PostgresCluster(const PostgresCluster&) = delete;
    PostgresCluster& operator=(const PostgresCluster&) = delete;

    void start() {
        const std::string folder = (folder_ / "").string();
        server_ = spawn({"postgres", "-D", data(), "-k", folder, "-c", "listen_addresses=", "-c",
                         "max_connections=300", "-c", "deadlock_timeout=100ms"});
        for (int i = 0; i < 600; ++i) {
            if (PQstatus(connected("postgres").get()) == CONNECTION_OK) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        throw std::runtime_error("PostgreSQL does not start");
    }

    /// Ends it: SIGINT closes its connections in order, SIGQUIT is as a crash, after which it recovers.
    void stop(int signal) {
        if (server_ <= 0) return;
        kill(server_, signal);
        waitpid(server_, nullptr, 0);
        server_ = 0;
    }

    /// Stops all of its processes without an end, so that they take what is sent to them and say nothing.
    void pause() const { signal_all(SIGSTOP); }
    void resume() const { signal_all(SIGCONT); }

    /// Returns the address of one of its databases.
    [[nodiscard]] std::string address(const std::string& database) const {
        return "postgres://sporeprint@/" + database + "?host=" + (folder_ / "").string();
    }

    /// Makes a database and returns its name.
    std::string new_database(const std::string& options = "") {
        const std::string name = "test_" + std::to_string(++databases_);
        execute("postgres", "CREATE DATABASE " + name + ' ' + options);
        return name;
    }

    /// Executes a statement and returns the first value of its result.
    std::string execute(const std::string& database, const std::string& statement) {
        const Connection connection = connected(database);
        const std::unique_ptr<PGresult, decltype(&PQclear)> result(
            PQexec(connection.get(), statement.c_str()), PQclear);
        const ExecStatusType status = PQresultStatus(result.get());
        if (status == PGRES_COMMAND_OK) return {};
        if (status != PGRES_TUPLES_OK) throw std::runtime_error(PQresultErrorMessage(result.get()));
        return PQntuples(result.get()) > 0 ? PQgetvalue(result.get(), 0, 0) : "";
    }

    /// Returns all that a dump of a database contains, bytes as hexadecimal digits.
    std::string dump(const std::string& database) {
        const std::string file = (folder_ / (database + ".sql").c_str()).string();
        finish(spawn({"pg_dump", "--dbname=" + address(database), "--file=" + file}));
        return text_of_file(file);
    }

  private:
    using Connection = std::unique_ptr<PGconn, decltype(&PQfinish)>;

    TemporaryFolder folder_;
    pid_t server_ = 0;
    int databases_ = 0;

    [[nodiscard]] Connection connected(const std::string& database) const {
        return {PQconnectdb(address(database).c_str()), PQfinish};
    }

    [[nodiscard]] std::string data() const { return (folder_ / "data").string(); }

    /// Returns the folder with the programs of the newest PostgreSQL; empty if there is none.
    static std::filesystem::path programs() {
        std::filesystem::path newest;
        std::error_code error;
        for (const auto& version :
             std::filesystem::directory_iterator("/usr/lib/postgresql", error))
            if (std::filesystem::exists(version.path() / "bin/initdb", error))
                newest = std::max(newest, version.path() / "bin");
        return newest;
    }

    /// Returns the user as whom it runs, where this program is run by root, as whom PostgreSQL refuses to run.
    static const passwd* account() { return geteuid() == 0 ? getpwnam("postgres") : nullptr; }

    /// Starts one of its programs, which ends when this one does.
    static pid_t spawn(const std::vector<std::string>& command) {
        const std::string program = (programs() / command.front()).string();
        const passwd* const user = account();
        const pid_t parent = getpid();
        std::vector<char*> arguments;
        for (const std::string& one : command) arguments.push_back(const_cast<char*>(one.c_str()));
        // By its own path a program finds those beside it.
        arguments.front() = const_cast<char*>(program.c_str());
        arguments.push_back(nullptr);
        const pid_t child = fork();
        if (child != 0) return child;
        if (user &&
            (setgroups(0, nullptr) != 0 || setgid(user->pw_gid) != 0 || setuid(user->pw_uid) != 0))
            _exit(126);
        prctl(PR_SET_PDEATHSIG, SIGQUIT);
        if (getppid() != parent || chdir("/") != 0) _exit(126);
        if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) _exit(126);
        execv(program.c_str(), arguments.data());
        _exit(127);
    }

    /// Sends a signal to the server and to the processes that it has for its connections.
    void signal_all(int signal) const {
        kill(server_, signal);
        const std::string task =
            "/proc/" + std::to_string(server_) + "/task/" + std::to_string(server_);
        std::ifstream children(task + "/children");
        for (pid_t child = 0; children >> child;) kill(child, signal);
    }

    static void finish(pid_t child) {
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
            throw std::runtime_error("a program of PostgreSQL ended with status " +
                                     std::to_string(status));
    }
};

}  // namespace sporeprint::server::test
