#pragma once

#include <cstdint>
#include <fstream>
#include <istream>
#include <limits>
#include <string>

namespace isophote {

/// The bytes of an OpenVDB file, as a stream with checks that OpenVDB leaves out. It throws std::ios::failure where the
/// file ends, and UserError where what it says of its own sizes cannot be.
class VdbInput : public std::istream {
 public:
  explicit VdbInput(const std::string& path);
  ~VdbInput() override { exceptions(std::ios::goodbit); }

  std::uint32_t read_word();
  /// A text or value after its length, which OpenVDB would allocate before it reads that much.
  std::string read_text();

  /// How the nodes of a tree are compressed.
  struct Nodes {
    std::streamoff begin;  ///< place of the first
    bool by_blosc, by_zip;
    bool active_only;        ///< but for nodes that say otherwise, only active values are kept
    std::int64_t per_value;  ///< bytes
  };
  /// What is read from `begin` on must be nodes whose sizes are right: OpenVDB and Blosc believe them.
  void check_nodes(const Nodes& nodes) { buffer_.nodes = nodes; }

 private:
  class Buffer : public std::filebuf {
   public:
    Nodes nodes{std::numeric_limits<std::streamoff>::max(), false, false, false, 0};

   protected:
    std::streamsize xsgetn(char* to, std::streamsize count) override;

   private:
    void note(const char* bytes, std::streamsize count);
    void check_chunk(std::streamsize count) const;

    std::int64_t mask_bits_ = 0, mask_on_ = 0;  ///< of the mask that was read last
    std::int64_t values_ = 0;                   ///< that come next, by that mask
    std::int64_t announced_ = 0;                ///< bytes of the chunk that comes next; below 0: not compressed
  };

  Buffer buffer_;
  std::streamoff end_ = 0;
};

}  // namespace isophote
