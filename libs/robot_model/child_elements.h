#pragma once

#include <tinyxml.h>

#include <vector>

namespace nao {

/** Children of an XML element that are elements, in the file's order; those that were returned may
 * be removed. @param Element  TiXmlElement, const or not. @param name  Of these only; nullptr: all.
 */
template <class Element>
std::vector<Element*> child_elements(Element& parent, const char* name = nullptr) {
  std::vector<Element*> children;
  for (Element* child = name ? parent.FirstChildElement(name) : parent.FirstChildElement();
       child != nullptr;
       child = name ? child->NextSiblingElement(name) : child->NextSiblingElement()) {
    children.push_back(child);
  }
  return children;
}

}  // namespace nao
