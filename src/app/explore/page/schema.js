// Reads the JSON Schema of scenes.

// Returns a schema with its references replaced by what they refer to in the schema `all`. A choice between a value and
// null is the value.
export function resolved(schema, all) {
  let found = schema ?? {};
  while (found.$ref) {
    const { $ref, ...own } = found;
    found = { ...$ref.slice(2).split("/").reduce((part, step) => part?.[step], all), ...own };
  }
  const some = (found.anyOf ?? []).filter(({ type }) => type !== "null");
  if (some.length === 1) return { ...resolved(some[0], all), description: found.description };
  return Array.isArray(found.type) ? { ...found, type: found.type.find((type) => type !== "null") } : found;
}

// Returns the kind of the field or the group for a part with this schema.
export function kindOf(schema) {
  if (schema.oneOf?.every((choice) => choice.properties?.kind)) return "variants";
  if (schema.enum || schema.oneOf) return "choice";
  if (schema.properties) return "object";
  return schema.type;
}
