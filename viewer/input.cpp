#include "input.h"

#include <utility>

namespace glint::viewer {

void InputQueue::add(InputEvent event) {
  using Kind = InputEvent::Kind;
  if (event.kind == Kind::motion && !events_.empty() && events_.back().kind == Kind::motion)
    events_.back() = std::move(event);
  else
    events_.push_back(std::move(event));
}

std::deque<InputEvent> InputQueue::take() {
  using Kind = InputEvent::Kind;
  std::deque<InputEvent> frame;
  while (!events_.empty()) {
    const Kind kind = events_.front().kind;
    // A click or scroll comes in the frame after the pointer moved there, because only then does
    // ImGui know what is under it. A key waits for the release of the one before.
    if (!frame.empty()) {
      const Kind last = frame.back().kind;
      if (last == Kind::motion || last == Kind::button || last == Kind::drop) break;
      if (last != Kind::character && kind != Kind::character && kind != Kind::focus) break;
      if (last == Kind::character && kind != Kind::character) break;
    }
    frame.push_back(std::move(events_.front()));
    events_.pop_front();
  }
  return frame;
}

}  // namespace glint::viewer
