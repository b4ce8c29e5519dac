#include "formulas.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"
#include "glint/shading/sum.h"

namespace glint::viewer {
namespace {

struct Form {
  LobeForm form = LobeForm::exact;
  int gamma = 8;
};

Form formOf(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  Form f;
  if (colon != std::string::npos) f.gamma = std::max(1, std::atoi(text.c_str() + colon + 1));
  f.form = name == "pow"          ? LobeForm::pow
           : name == "integer"    ? LobeForm::integer
           : name == "lyon"       ? LobeForm::lyon
           : name == "lyon-tuned" ? LobeForm::lyonTuned
           : name == "lyon-cross" ? LobeForm::lyonCross
           : name == "pade"       ? LobeForm::pade
           : name == "gaussian"   ? LobeForm::gaussian
           : name == "none"       ? LobeForm::none
                                  : LobeForm::exact;
  return f;
}

}  // namespace

SumValue lightValue(const SumInput& input, const glm::dvec3& N, const glm::dvec3& L,
                    const glm::dvec3& V, const glm::dvec3& intensity) {
  SumParameters p;
  p.ambient = input.ambient;
  p.diffuse = input.diffuse;
  p.specular = input.specular;
  p.exponent = input.exponent;
  p.blinnFactor = input.blinnFactor;
  const Form form = formOf(input.highlight);
  p.highlight = form.form;
  p.gamma = form.gamma;
  const LightTerms terms =
      input.blinn ? blinnPhongLight(p, N, L, V, intensity) : phongLight(p, N, L, V, intensity);
  return {terms.matte, terms.specular};
}

double lobeValue(const SumInput& input, const std::string& form, const glm::dvec3& N,
                 const glm::dvec3& L, const glm::dvec3& V) {
  const Form f = formOf(form);
  const double lambda = input.blinn ? blinnLambda(N, L, V) : phongLambda(N, L, V);
  return lobe(f.form, f.gamma, lambda,
              input.blinn ? input.blinnFactor * input.exponent : input.exponent);
}

double fresnelValue(const std::string& form, double cosTheta, double n1, double n2,
                    double schlickExponent) {
  if (form == "textbook") return fresnelTextbook(cosTheta, n1, n2);
  if (form == "schlick") return schlick(cosTheta, n1, n2, schlickExponent);
  if (form == "schlick-exp2") return schlickExp2(cosTheta, n1, n2);
  if (form == "rational")
    return schlickRational(cosTheta, fresnelConstants(n1, n2), rationalMinimax(n1, n2));
  return fresnelExact(cosTheta, n1, n2);
}

}  // namespace glint::viewer
