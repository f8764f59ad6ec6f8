#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "isophote/core/error.h"

namespace isophote {

/// `text` as one line that can be shown: control characters replaced, its middle left out where it is very long.
std::string one_line(std::string_view text);

/// What messages call an element of a glTF array: `meshes[2] "Chair"`.
std::string place_name(std::string_view array, std::size_t index, const std::string& name);

/// Calls `body`; a UserError leaves it with `place: ` before its message.
template <class Body>
auto with_place(const std::string& place, const Body& body) -> decltype(body()) {
  try {
    return body();
  } catch (const UserError& error) {
    throw UserError(place + ": " + error.what());
  }
}

}  // namespace isophote
