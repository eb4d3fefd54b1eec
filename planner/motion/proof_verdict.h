#pragma once

#include <string>

namespace regrasp::motion {

/// What exact arithmetic says of a proof.
struct ProofVerdict {
  enum class Kind {
    kForceClosure,     ///< proved
    kNotForceClosure,  ///< refuted
    kNothing,          ///< the proof proves neither
  };
  Kind kind = Kind::kNothing;
  std::string why;  ///< of kNothing, for people

  /// Force closure is proved.
  [[nodiscard]] bool proves() const { return kind == Kind::kForceClosure; }
};

}  // namespace regrasp::motion
