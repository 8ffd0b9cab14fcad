/// A WAV file that is whole at every moment.
#pragma once

#include <filesystem>
#include <span>

struct sf_private_tag;

namespace overt {

/// One channel of 16 or 24 bits. After each write the header says how long the file is: a program that is
/// killed leaves what it had written, playable.
class WavFile {
  public:
    /// The file must not exist. Throws RecordError.
    WavFile(const std::filesystem::path& file, int sample_rate_hz, int bits);
    ~WavFile();
    WavFile(const WavFile&) = delete;
    WavFile& operator=(const WavFile&) = delete;

    /// Shares of full scale; what is beyond is clipped. Throws RecordError.
    void write(std::span<const float> samples);

    /// Nothing may be written afterwards. Throws RecordError if not all of it reached the system.
    void close();

  private:
    std::filesystem::path file_;
    sf_private_tag* sound_ = nullptr;
};

} // namespace overt
