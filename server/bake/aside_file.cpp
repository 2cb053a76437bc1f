#include "server/bake/aside_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "api/cache/write_all.h"
#include "api/http/random.h"
#include "api/library/tokens.h"

namespace sporeprint::server {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_with(const fs::path& path, const std::string& what, int code) {
    throw std::runtime_error(path.string() + " " + what + ": " +
                             std::generic_category().message(code));
}

/// Returns whether this process has the only lock of an open file.
bool lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0; }

}  // namespace

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("libcrypto has no SHA-256");
}

void Sha256::add(const void* data, std::size_t size) {
    if (EVP_DigestUpdate(context_.get(), data, size) != 1)
        throw std::runtime_error("libcrypto has no SHA-256");
}

std::string Sha256::hex() {
    api::Digest digest{};
    if (EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) != 1)
        throw std::runtime_error("libcrypto has no SHA-256");
    return api::hex_of(digest);
}

FileDigest digest_of_file(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail_with(path, "cannot be read", errno);
    FileDigest out;
    Sha256 sha256;
    std::vector<unsigned char> block(std::size_t{1} << 18U);
    ssize_t got = 0;
    while ((got = ::read(file, block.data(), block.size())) != 0) {
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) break;
        sha256.add(block.data(), static_cast<std::size_t>(got));
        out.bytes += static_cast<std::uint64_t>(got);
    }
    const int code = errno;
    ::close(file);
    if (got < 0) fail_with(path, "cannot be read", code);
    out.sha256 = sha256.hex();
    return out;
}

AsideFile::AsideFile(fs::path path) : path_(std::move(path)) {
    // Who removes what others have left may be between the two steps of open(): then there is no such name.
    for (int tries = 0; tries < 10; ++tries) {
        open();
        struct stat status {};
        if (::fstat(file_, &status) == 0 && status.st_nlink > 0) return;
        ::close(std::exchange(file_, -1));
    }
    fail_with(aside_, "is removed again and again", EAGAIN);
}

AsideFile::~AsideFile() {
    if (file_ < 0) return;
    ::close(file_);
    std::error_code gone;
    fs::remove(aside_, gone);
}

void AsideFile::open() {
    aside_ = path_.parent_path() / "aside" / api::random_name();
    file_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) fail("cannot be written");
    // On a file system without locks nobody removes what is left aside.
    static_cast<void>(lock(file_));
}

void AsideFile::fail(const char* what) const { fail_with(path_, what, errno); }

void AsideFile::write(const void* data, std::size_t size) {
    sha256_.add(data, size);
    bytes_ += size;
    if (const std::error_code error = api::write_all(file_, data, size))
        fail_with(path_, "cannot be written", error.value());
}

void AsideFile::synchronize() {
    if (::fsync(file_) != 0) fail("cannot be written");
}

std::string AsideFile::commit() {
    synchronize();
    if (::rename(aside_.c_str(), path_.c_str()) != 0) fail("cannot be put into its place");
    ::close(std::exchange(file_, -1));
    // The name is on the disk when its folder is. Not every file system can tell.
    const fs::path folder = path_.parent_path();
    if (const int open = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); open >= 0) {
        ::fsync(open);
        ::close(open);
    }
    return sha256_.hex();
}

bool AsideFile::commit_first() {
    synchronize();
    if (::link(aside_.c_str(), path_.c_str()) == 0) return true;
    if (errno != EEXIST) fail("cannot be put into its place");
    return false;
}

void remove_left_aside(const fs::path& aside) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(aside, error)) {
        const int file = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) continue;
        if (lock(file)) fs::remove(entry.path(), error);
        ::close(file);
    }
}

}  // namespace sporeprint::server
