/** Values of the protocol's enums by name, as text keys and style sheets have them: Mode.GETTING_UP is "getting-up". */
type Kebab<Name> = Name extends `${infer Head}_${infer Rest}` ? `${Lowercase<Head>}-${Kebab<Rest>}` : Lowercase<Name & string>;

/** @param otherwise  for a value that this page does not know: a newer gateway may. */
export function nameOf<Values extends Readonly<Record<string, string | number>>>(
    values: Values, value: number, otherwise: Kebab<keyof Values>): Kebab<keyof Values> {
  const name = values[value as keyof Values];
  return typeof name === "string" ? name.toLowerCase().replaceAll("_", "-") as Kebab<keyof Values> : otherwise;
}
