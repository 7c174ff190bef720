#include "app/buttons.h"

namespace vindu::app {
namespace {

struct ButtonName {
  Buttons bit;
  const char* name;
};
constexpr ButtonName kButtons[] = {{0x0100, "Left"},  {0x0200, "Right"}, {0x0400, "Down"},
                                   {0x0800, "Up"},    {0x1000, "Plus"},  {0x0001, "Two"},
                                   {0x0002, "One"},   {0x0004, "B"},     {0x0008, "A"},
                                   {0x0010, "Minus"}, {0x0080, "Home"}};

}  // namespace

std::string text_of(Buttons buttons) {
  std::string text;
  for (const ButtonName& button : kButtons)
    if (buttons & button.bit) text += (text.empty() ? "" : "+") + std::string(button.name);
  return text.empty() ? "-" : text;
}

}  // namespace vindu::app
