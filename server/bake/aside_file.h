// A file that is there completely or not at all, whatever ends the process that writes it.
#pragma once

#include <openssl/evp.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sporeprint::server {

/// The SHA-256 of bytes that come in pieces.
class Sha256 {
  public:
    /// throws  std::runtime_error if libcrypto has none
    Sha256();
    void add(const void* data, std::size_t size);
    /// Returns 64 lower-case hexadecimal digits. To be called once, at the end.
    [[nodiscard]] std::string hex();

  private:
    struct Free {
        void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    };
    std::unique_ptr<EVP_MD_CTX, Free> context_;
};

/// Returns the SHA-256 of a file and its length.
///
/// throws  std::runtime_error, which names the file, if it cannot be read
struct FileDigest {
    std::string sha256;
    std::uint64_t bytes = 0;
};
[[nodiscard]] FileDigest digest_of_file(const std::filesystem::path& path);

/// Writes a file under a random name in the folder `aside` beside its place, which a lock tells from what a killed
/// process has left there, and renames it when it is complete and on the disk.
///
/// All functions throw std::runtime_error with the file's name and the error of the system.
class AsideFile {
  public:
    /// path  in a folder that has a folder `aside`
    explicit AsideFile(std::filesystem::path path);
    /// Removes the file if it was not committed.
    ~AsideFile();
    AsideFile(const AsideFile&) = delete;
    AsideFile& operator=(const AsideFile&) = delete;

    void write(const void* data, std::size_t size);
    void write(std::string_view text) { write(text.data(), text.size()); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

    /// Puts the file into its place, where it replaces another one.
    ///
    /// returns  its SHA-256
    std::string commit();

    /// Puts the file into its place unless there is one. Returns false then.
    bool commit_first();

  private:
    void open();
    void synchronize();
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path path_, aside_;
    int file_ = -1;
    std::uint64_t bytes_ = 0;
    Sha256 sha256_;
};

/// Removes what processes that ended have left in a folder `aside`; files of others are locked and stay.
void remove_left_aside(const std::filesystem::path& aside);

}  // namespace sporeprint::server
