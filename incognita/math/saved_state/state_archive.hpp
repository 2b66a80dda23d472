// The archives of cereal to which the state of a run is saved, and from which it is restored.
//
// A class that has state between frames declares `void state(StateArchive&)`, which names all of its members: in one structured
// binding wherever possible, so that the compiler refuses it when a member is added. A plain struct has a template
// serialize(archive, struct) in the source that saves it. Headers need only the forward declaration `class StateArchive`.
//
// The archives write what cereal::BinaryOutputArchive does, but to memory, and they check each size before they allocate:
// a damaged file must not take all memory. Numbers have the byte order of the computer, which must be little-endian.
#pragma once

#include <bit>
#include <cereal/cereal.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace incognita {

static_assert(std::endian::native == std::endian::little, "saved states are little-endian");

/// A part of the run does not know how to save its state.
struct CannotBeSaved : std::logic_error {
  using std::logic_error::logic_error;
};

/// What was read is no state, or not that of the part that restores it.
struct DamagedState : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class StateWriter : public cereal::OutputArchive<StateWriter, cereal::AllowEmptyClassElision> {
 public:
  StateWriter() : OutputArchive(this) {}
  void write(const void* data, std::size_t bytes) { bytes_.append(static_cast<const char*>(data), bytes); }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class StateReader : public cereal::InputArchive<StateReader, cereal::AllowEmptyClassElision> {
 public:
  /// The bytes must outlive it.
  explicit StateReader(std::string_view bytes) : InputArchive(this), bytes_(bytes) {}
  /// Throws DamagedState if there are fewer bytes.
  void read(void* data, std::size_t bytes) {
    need(bytes, 1);
    std::memcpy(data, bytes_.data() + at_, bytes);
    at_ += bytes;
  }
  /// Throws DamagedState unless that many elements of that many bytes are left.
  void need(std::uint64_t count, std::size_t bytes_each) const;
  std::size_t position() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// One of the two: what names the members of a class once serves both directions.
class StateArchive {
 public:
  explicit StateArchive(StateWriter& to) : to_(&to) {}
  explicit StateArchive(StateReader& from) : from_(&from) {}

  bool restores() const { return from_ != nullptr; }

  template <class... Members>
  void operator()(Members&... members) {
    if (to_)
      (*to_)(members...);
    else
      (*from_)(members...);
  }

  /// Plain numbers beside each other in memory.
  void numbers(double* values, std::size_t count) {
    if (to_) return to_->write(values, count * sizeof(double));
    from_->need(count, sizeof(double));
    from_->read(values, count * sizeof(double));
  }

  /// Of a container whose size is configuration: its elements, where they are. Throws DamagedState for another size.
  template <class Container>
  void each(Container& container, const char* what) {
    expect_size(container.size(), what);
    for (auto& element : container) (*this)(element);
  }
  /// Saves a number that the restored part must have, too.
  void expect_size(std::size_t size, const char* what);

 private:
  StateWriter* to_ = nullptr;
  StateReader* from_ = nullptr;
};

inline StateArchive both_ways(StateWriter& archive) { return StateArchive(archive); }
inline StateArchive both_ways(StateReader& archive) { return StateArchive(archive); }

template <class Archive>
concept AnyStateArchive = std::same_as<Archive, StateWriter> || std::same_as<Archive, StateReader>;

template <class T>
concept HasState = requires(T& value, StateArchive& archive) {
  value.state(archive);
};

template <AnyStateArchive Archive, HasState T>
void serialize(Archive& archive, T& value) {
  StateArchive both = both_ways(archive);
  value.state(both);
}

// What cereal asks of an archive: numbers, blocks of them, sizes, names (which a binary archive leaves out).

template <class T>
requires std::is_arithmetic_v<T>
void save(StateWriter& archive, const T& value) { archive.write(&value, sizeof value); }
template <class T>
requires std::is_arithmetic_v<T>
void load(StateReader& archive, T& value) {
  if constexpr (std::same_as<T, bool>) {
    std::uint8_t byte = 0;
    archive.read(&byte, 1);
    if (byte > 1) throw DamagedState("a byte that is neither false nor true");
    value = byte == 1;
  } else {
    archive.read(&value, sizeof value);
  }
}

template <class T>
void save(StateWriter& archive, const cereal::BinaryData<T>& block) {
  archive.write(block.data, static_cast<std::size_t>(block.size));
}
template <class T>
void load(StateReader& archive, cereal::BinaryData<T>& block) {
  archive.read(block.data, static_cast<std::size_t>(block.size));
}

template <class T>
void save(StateWriter& archive, const cereal::SizeTag<T>& tag) {
  const std::uint64_t size = tag.size;
  archive.write(&size, sizeof size);
}
/// Every element takes a byte or more.
template <class T>
void load(StateReader& archive, cereal::SizeTag<T>& tag) {
  std::uint64_t size = 0;
  archive.read(&size, sizeof size);
  archive.need(size, 1);
  tag.size = static_cast<std::remove_reference_t<T>>(size);
}

template <AnyStateArchive Archive, class T>
void serialize(Archive& archive, cereal::NameValuePair<T>& pair) {
  archive(pair.value);
}

}  // namespace incognita

CEREAL_SETUP_ARCHIVE_TRAITS(incognita::StateReader, incognita::StateWriter)
