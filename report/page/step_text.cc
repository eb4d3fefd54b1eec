#include "report/page/step_text.h"

#include "render/picture/caption.h"

namespace regrasp::report {

std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index) {
  return Capitalized(render::EntryTitle(plan, index));
}

std::string StepName(plan::EntryIndex index) {
  return index == 0 ? "the hold" : "step " + std::to_string(index);
}

std::string WhyAndMend(const std::string& why, const std::string& mend) {
  return (why.empty() ? "" : " Why: " + why + ".") +
         (mend.empty() ? "" : " What would mend it: " + mend + ".");
}

std::string Capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
  return text;
}

}  // namespace regrasp::report
