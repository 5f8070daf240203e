declare module "*.css" {
    const text: string;
    export default text;
}
declare module "linkage:worker" {
    const text: string;
    export default text;
}
declare module "linkage:examples" {
    const examples: { name: string; text: string }[];
    export default examples;
}
declare module "linkage:licences" {
    const text: string;
    export default text;
}
