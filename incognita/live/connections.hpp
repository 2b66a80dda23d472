// Which connections may be open at once. Those that have shown no right to the data yet, strangers, give way to others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace incognita {

/// Of one thread.
class Connections {
 public:
  /// `most`: open ones; `most_strangers`: of one address, at least 1.
  Connections(std::size_t most, std::size_t most_strangers) : most_(most), most_strangers_(most_strangers) {}
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  /// The place of an open connection, as long as it lives. A stranger at first.
  class Place {
   public:
    /// `from`: address of the other side. `close` closes the connection if it must give way; its place then counts no more.
    Place(Connections& connections, std::string from, std::function<void()> close);
    ~Place();
    Place(Place&& other) noexcept
        : of_(std::exchange(other.of_, nullptr)), number_(other.number_), is_trusted_(other.is_trusted_) {}
    Place& operator=(Place&&) = delete;

    /// It has access: it does not give way any more.
    void trust();
    /// It was of use without access: other strangers give way before it does.
    void renew();

   private:
    Connections* of_;
    std::uint64_t number_;
    bool is_trusted_ = false;
  };

  /// Makes room for a connection of that address, by closing the stranger there, or anywhere, that was of use the longest ago. `log`
  /// receives whom. False if all connections have access.
  bool make_room(const std::string& from, const std::function<void(const std::string&)>& log);

 private:
  struct Stranger {
    std::string from;
    std::function<void()> close;
  };
  using Strangers = std::map<std::uint64_t, Stranger>;

  std::size_t strangers_of(const std::string& from) const;
  void close(Strangers::iterator stranger);

  std::size_t most_, most_strangers_, open_ = 0;
  Strangers strangers_;  ///< by a number that increases
  std::uint64_t next_number_ = 0;
};

}  // namespace incognita
