#pragma once

#include <stdexcept>
#include <string>

namespace isophote {

/// Something the user gave is wrong: one line that names the file and the place. The program exits with 1.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The program was called wrongly (a flag, a method's name, a combination that does not exist). It exits with 2.
struct UsageError : UserError {
  using UserError::UserError;
};

}  // namespace isophote
