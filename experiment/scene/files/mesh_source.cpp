#include "experiment/scene/files/mesh_source.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

class FileDescriptor {
  public:
    // Without O_NONBLOCK, opening a named pipe would wait for a writer before it could be refused.
    explicit FileDescriptor(const std::filesystem::path& path)
        : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
    ~FileDescriptor() {
        if (number_ >= 0)
            ::close(number_);
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    int number() const { return number_; }

  private:
    int number_;
};

std::string reason(int error_number) { return std::generic_category().message(error_number); }

} // namespace

MeshSource::MeshSource(std::filesystem::path path) : path_(std::move(path)) {
    const FileDescriptor file(path_);
    if (file.number() < 0) {
        if (errno == ENOENT)
            fail("there is no such mesh file.");
        fail(fmt::format("this mesh file cannot be opened: {}.", reason(errno)));
    }
    struct ::stat status {};
    if (::fstat(file.number(), &status) != 0)
        fail(fmt::format("cannot be examined: {}.", reason(errno)));
    if (S_ISDIR(status.st_mode))
        fail("this is a folder; name the mesh file in it.");
    if (!S_ISREG(status.st_mode))
        fail("this is not a regular file; a mesh is read from one.");

    const auto expected = static_cast<std::size_t>(status.st_size);
    bytes_ = std::make_unique_for_overwrite<char[]>(expected);
    while (size_ < expected) {
        const ::ssize_t got = ::read(file.number(), bytes_.get() + size_, expected - size_);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail_at_byte(size_, fmt::format("reading stopped: {}.", reason(errno)));
        if (got == 0)
            break;
        size_ += static_cast<std::size_t>(got);
    }
    if (bytes().starts_with("\xEF\xBB\xBF"))
        mark_ = 3;
    if (bytes().empty())
        fail("this mesh file is empty.");
}

void MeshSource::fail(std::string_view message) const {
    throw InputError(fmt::format("{}: {}", path_.string(), message));
}

void MeshSource::fail_at(std::size_t line, std::size_t column, std::string_view message) const {
    throw InputError(fmt::format("{}:{}:{}: {}", path_.string(), line, column, message));
}

void MeshSource::fail_at_byte(std::size_t offset, std::string_view message) const {
    throw InputError(fmt::format("{}: byte {}: {}", path_.string(), mark_ + offset, message));
}

bool is_padding(std::string_view bytes) {
    return bytes.find_first_not_of(std::string_view(" \t\r\n\v\f\0", 7)) == std::string_view::npos;
}

} // namespace overt
